// How far apart two states of a pixel are.
#pragma once

#include <algorithm>
#include <cmath>

#include "image/sanitise.h"
#include "scatter/coc_table.h"

namespace pullfocus {

// Euclidean, in linear R, G, B.
template <SampleType type>
double colour_distance(const Pixel<type>& a, const Pixel<type>& b) noexcept {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = static_cast<double>(sample_value(a.rgba[c])) - static_cast<double>(sample_value(b.rgba[c]));
    sum += d * d;
  }
  return std::sqrt(sum);
}

template <SampleType type>
double alpha_distance(const Pixel<type>& a, const Pixel<type>& b) noexcept {
  return std::fabs(static_cast<double>(sample_value(a.rgba[3])) - static_cast<double>(sample_value(b.rgba[3])));
}

// The largest change of any channel of linear RGBA.
template <SampleType type>
double channel_distance(const Pixel<type>& a, const Pixel<type>& b) noexcept {
  double largest = 0;
  for (int c = 0; c < 4; ++c) {
    const double d = static_cast<double>(sample_value(a.rgba[c])) - static_cast<double>(sample_value(b.rgba[c]));
    largest = std::max(largest, std::fabs(d));
  }
  return largest;
}

// Of signed table diameters, in pixels.
inline double coc_distance(const CocTable& coc, int a, int b) noexcept {
  return std::fabs(std::copysign(coc.diameter(a), a) - std::copysign(coc.diameter(b), b));
}

}  // namespace pullfocus
