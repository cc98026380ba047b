// Hand-made frames, and options for them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "filter/filter.h"

namespace pullfocus::test {

struct Rgba {
  float r = 0, g = 0, b = 0, a = 1;
};

inline void set_colour(ColourImage& image, int x, int y, const Rgba& colour) {
  const float samples[] = {colour.r, colour.g, colour.b, colour.a};
  for (int c = 0; c < 4; ++c) image.set(x, y, c, samples[c]);
}

// Calls visit(x, y) for every pixel, row by row; not for the rows below one in which an assertion failed.
template <typename Visit>
void for_each_in(const Window& window, Visit&& visit) {
  for (int y = window.y0; y < window.y1 && !testing::Test::HasFatalFailure(); ++y) {
    for (int x = window.x0; x < window.x1; ++x) visit(x, y);
  }
}

// One colour and one depth everywhere.
inline Frame flat_frame(const Window& window, SampleType type, const Rgba& colour, float depth) {
  Frame frame{ColourImage(window, type), Plane(window, depth)};
  for_each_in(window, [&](int x, int y) { set_colour(frame.colour, x, y, colour); });
  return frame;
}

// What a reader hands over where a file says nothing.
inline Frame empty_frame(const Window& window, SampleType type, DepthKind kind = DepthKind::planar) {
  return flat_frame(window, type, {0, 0, 0, 0}, background_depth(kind));
}

// The depth is the diameter of the circle of confusion itself.
inline constexpr CocFunction coc_as_depth{DepthKind::coc, 1, 0};

// Results in float, so that nothing is lost before a test sees it; without visibility, whose tests are their own.
inline FilterOptions options_up_to(double max_coc_px) {
  FilterOptions options;
  options.kernel.max_coc_px = std::max(1., max_coc_px);
  options.output_type = SampleType::float32;
  options.visibility.kind = VisibilityOptions::Kind::none;
  return options;
}

}  // namespace pullfocus::test
