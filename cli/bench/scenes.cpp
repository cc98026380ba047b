#include "bench/scenes.h"

#include <cmath>
#include <random>

namespace pullfocus::cli::bench {

namespace {

Frame empty_frame(int width, int height, SampleType type) {
  Frame frame;
  frame.colour.reset({0, 0, width, height}, type);
  frame.depth.reset({0, 0, width, height}, 0);
  frame.has_alpha = false;
  return frame;
}

template <typename Random>
void set_noise(Frame& frame, int x, int y, Random& random) {
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, uniform(random));
  frame.colour.set(x, y, 3, 1);
}

}  // namespace

Frame planes_and_floor(int width, int height, float largest_coc, SampleType type) {
  Frame frame = empty_frame(width, height, type);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  const float planes[] = {-1, -0.5f, 0.02f};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int sixth = x * 6 / width;
      float coc = sixth < 3 ? planes[sixth] : static_cast<float>(y) / static_cast<float>(height);
      if (uniform(random) < 0.06f) coc = uniform(random) * 2 - 1;
      frame.depth.at(x, y) = coc * largest_coc;
      set_noise(frame, x, y, random);
    }
  }
  return frame;
}

Frame waves(int width, int height, float largest_coc) {
  Frame frame = empty_frame(width, height, SampleType::half);
  std::mt19937 random(1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float wave = std::sin(static_cast<float>(x) / 40) * std::sin(static_cast<float>(y) / 30);
      frame.depth.at(x, y) = largest_coc * (1 + wave / 16) / (1 + 1.f / 16);
      set_noise(frame, x, y, random);
    }
  }
  return frame;
}

void darken(Frame& frame, double share, Pattern pattern) {
  const Window& w = frame.window();
  const double side = pattern == Pattern::patch ? std::sqrt(share) : 1;
  const int width = static_cast<int>(w.width() * side), height = static_cast<int>(w.height() * side);
  const int x0 = w.x0 + (w.width() - width) / 2, y0 = w.y0 + (w.height() - height) / 2;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int y = y0; y < y0 + height; ++y) {
    for (int x = x0; x < x0 + width; ++x) {
      if (pattern == Pattern::random && uniform(random) >= share) continue;
      frame.colour.set(x, y, 0, frame.colour.get(x, y, 0) * 0.5f);
    }
  }
}

}  // namespace pullfocus::cli::bench
