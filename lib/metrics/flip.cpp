#include "metrics/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "image/error.h"
#include "metrics/convolve.h"
#include "metrics/opponent.h"
#include "metrics/planes.h"

namespace pullfocus {

namespace {

constexpr double kPi = std::numbers::pi;
using Opponent = std::array<Grid, 3>;  // Yy, cx, cz

void for_rows(const Window& w, const std::function<void(int)>& body) { tbb::parallel_for(w.y0, w.y1, body); }

Opponent opponent(const ColourImage& picture, const Window& w) {
  Opponent out = displayable_planes(picture, w);
  for_rows(w, [&](int y) {
    for (int x = 0; x < w.width(); ++x) {
      const Triple v = to_ycxcz({out[0].row(y)[x], out[1].row(y)[x], out[2].row(y)[x]});
      for (std::size_t c = 0; c < 3; ++c) out[c].row(y)[x] = v[c];
    }
  });
  return out;
}

// One term a sqrt(pi/b) exp(-pi^2 d^2 / b) of a contrast sensitivity in space, d in degrees.
struct Term {
  double a, b;
};

// Sums of Gaussians do not separate, so each term is filtered on its own; together they have weight 1.
Grid sensed(const Grid& plane, std::initializer_list<Term> terms, int radius, double ppd) {
  double total = 0;
  std::vector<std::pair<double, Taps>> filters;
  for (const Term& t : terms) {
    Taps taps = make_taps(radius, [&](double x) { return std::exp(-kPi * kPi * x * x / (ppd * ppd * t.b)); });
    double sum = 0;
    for (const double tap : taps) sum += tap;
    const double height = t.a * std::sqrt(kPi / t.b);
    total += height * sum * sum;
    filters.emplace_back(height, std::move(taps));
  }
  Grid out;
  for (auto& [height, taps] : filters) {
    Taps scaled = taps;
    for (double& tap : scaled) tap *= height / total;
    Grid part = correlate(plane, scaled, taps);
    if (out.values.empty()) {
      out = std::move(part);
    } else {
      std::ranges::transform(out.values, part.values, out.values.begin(), std::plus<>());
    }
  }
  return out;
}

Opponent filtered(const Opponent& in, double ppd) {
  constexpr double widest = 0.04;  // the largest b: three standard deviations of it are the reach
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * kPi * kPi)) * ppd));
  return {sensed(in[0], {{1, 0.0047}}, radius, ppd), sensed(in[1], {{1, 0.0053}}, radius, ppd),
          sensed(in[2], {{34.1, 0.04}, {13.5, 0.025}}, radius, ppd)};
}

Triple hunt_lab_of(const Opponent& image, int x, int y) noexcept {
  Triple rgb = from_ycxcz({image[0].row(y)[x], image[1].row(y)[x], image[2].row(y)[x]});
  for (double& v : rgb) v = std::clamp(v, 0., 1.);
  return to_hunt_lab(rgb);
}

// dE_c: distances up to 0.4 of the largest (between green and blue) take 0..0.95, the rest what remains.
double colour_error(const Triple& a, const Triple& b) noexcept {
  static const double largest = std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), 0.7);
  const double distance = std::pow(hyab(a, b), 0.7), knee = 0.4 * largest;
  if (distance < knee) return 0.95 * distance / knee;
  return std::min(1., 0.95 + 0.05 * (distance - knee) / (largest - knee));
}

// Positive taps sum to 1, negative ones to -1.
Taps balanced(Taps taps) {
  double positive = 0, negative = 0;
  for (const double tap : taps) (tap > 0 ? positive : negative) += std::fabs(tap);
  for (double& tap : taps) tap /= tap > 0 ? positive : negative;
  return taps;
}

struct Features {
  Grid edge_x, edge_y, point_x, point_y;

  Features(const Grid& yy, double ppd) {
    const double deviation = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gauss = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    Taps smooth = make_taps(radius, gauss);
    double sum = 0;
    for (const double tap : smooth) sum += tap;
    for (double& tap : smooth) tap /= sum;
    const Taps edge = balanced(make_taps(radius, [&](double x) { return -x * gauss(x); }));
    const Taps point =
        balanced(make_taps(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
    edge_x = correlate(yy, edge, smooth);
    edge_y = correlate(yy, smooth, edge);
    point_x = correlate(yy, point, smooth);
    point_y = correlate(yy, smooth, point);
  }
  static double magnitude(const Grid& a, const Grid& b, int x, int y) noexcept {
    return std::hypot(a.row(y)[x], b.row(y)[x]);
  }
  double edge(int x, int y) const noexcept { return magnitude(edge_x, edge_y, x, y); }
  double point(int x, int y) const noexcept { return magnitude(point_x, point_y, x, y); }
};

// dE_f. Filters have no weight in all, so Yy's offset of 16 does not matter; 1/116 makes it 0..1.
double feature_error(const Features& a, const Features& b, int x, int y) noexcept {
  const double difference =
      std::max(std::fabs(a.edge(x, y) - b.edge(x, y)), std::fabs(a.point(x, y) - b.point(x, y))) / 116;
  return std::min(1., std::sqrt(difference / std::numbers::sqrt2));
}

}  // namespace

Plane flip_map(const ColourImage& picture, const ColourImage& reference, const Window& window,
               double pixels_per_degree) {
  require_pixels(window);
  if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000)) {
    throw Error(ErrorCode::usage, "the pixels per degree of FLIP must be 1 to 1000");
  }
  const Opponent a = opponent(picture, window), b = opponent(reference, window);
  const Features features_a(a[0], pixels_per_degree), features_b(b[0], pixels_per_degree);
  const Opponent sensed_a = filtered(a, pixels_per_degree), sensed_b = filtered(b, pixels_per_degree);
  Plane map(window, 0);
  for_rows(window, [&](int y) {
    for (int x = 0; x < window.width(); ++x) {
      const double colour = colour_error(hunt_lab_of(sensed_a, x, y), hunt_lab_of(sensed_b, x, y));
      map.row(y)[x] = static_cast<float>(std::pow(colour, 1 - feature_error(features_a, features_b, x, y)));
    }
  });
  return map;
}

double flip(const ColourImage& picture, const ColourImage& reference, const Window& window, double pixels_per_degree) {
  return mean(flip_map(picture, reference, window, pixels_per_degree), window);
}

}  // namespace pullfocus
