// Analytic depth, sampled as renderers do without and with a filter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "camera/thin_lens.h"
#include "image/frame.h"

namespace pullfocus::test {

inline constexpr float infinity = std::numeric_limits<float>::infinity();

using DepthAt = std::function<double(double x, double y)>;  // stored depth at a point; pixel centres at halves

inline Frame frame_of(const Window& window) {
  Frame frame{ColourImage(window, SampleType::half), Plane(window, 1)};
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) frame.colour.set(x, y, 3, 1);
  }
  return frame;
}

// One sample at the centre, as a first-hit depth has it.
inline Frame clean(const Window& window, const DepthAt& depth) {
  Frame frame = frame_of(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) frame.depth.at(x, y) = static_cast<float>(depth(x + 0.5, y + 0.5));
  }
  return frame;
}

// The mean over a square of `size` pixels around the centre.
inline Frame box_filtered(const Window& window, const DepthAt& depth, double size) {
  constexpr int n = 8;
  Frame frame = frame_of(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      double sum = 0;
      for (int i = 0; i < n * n; ++i) {
        sum += depth(x + 0.5 + size * ((i % n + 0.5) / n - 0.5), y + 0.5 + size * ((i / n + 0.5) / n - 0.5));
      }
      frame.depth.at(x, y) = static_cast<float>(sum / (n * n));
    }
  }
  return frame;
}

inline std::int64_t differing(const Frame& a, const Frame& b) {
  std::int64_t n = 0;
  const Window& w = a.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) n += std::memcmp(&a.depth.at(x, y), &b.depth.at(x, y), sizeof(float)) != 0;
  }
  return n;
}

// Sum of |difference of CoC| in px.
inline double coc_error(const Frame& a, const Frame& b, const CocFunction& coc) {
  const auto diameter = [&](float z) {
    return static_cast<double>(is_background(coc.kind, z) ? coc.background() : coc(z));
  };
  double sum = 0;
  const Window& w = a.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) sum += std::fabs(diameter(a.depth.at(x, y)) - diameter(b.depth.at(x, y)));
  }
  return sum;
}

// Depth of a plane that faces the camera at `z` in the picture's corner and recedes by `tilt` in 1/z a pixel.
inline DepthAt plane(double z, double tilt_x, double tilt_y) {
  return [=](double x, double y) { return 1 / (1 / z + tilt_x * x + tilt_y * y); };
}

// Discs and slanted cards before a slanted wall, placed at random.
inline DepthAt cards(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  struct Card {
    double x, y, r, nx, ny, z;
    bool disc;
  };
  std::vector<Card> all;
  for (int i = 0; i < 5; ++i) {
    const double angle = uniform(0, 6.28);
    all.push_back(
        {uniform(0, 96), uniform(0, 80), uniform(10, 25), std::cos(angle), std::sin(angle), uniform(1, 5), i % 2 == 0});
  }
  const DepthAt wall = plane(9, uniform(-2e-4, 2e-4), uniform(-2e-4, 2e-4));
  return [=](double x, double y) {
    double z = wall(x, y);
    for (const Card& c : all) {
      const double u = (x - c.x) * c.nx + (y - c.y) * c.ny, v = (y - c.y) * c.nx - (x - c.x) * c.ny;
      const bool inside = c.disc ? u * u + v * v < c.r * c.r : std::fabs(u) < c.r && std::fabs(v) < c.r / 2;
      if (inside) z = std::min(z, 1 / (1 / c.z + 1e-4 * u));
    }
    return z;
  };
}

inline constexpr Window window{-3, 5, 93, 85};
inline constexpr CocFunction lens{DepthKind::planar, 60, 1.f / 3};

}  // namespace pullfocus::test
