// How far pictures are apart, over the colours of any number of frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "image/frame.h"

namespace pullfocus::cli::bench {

class PictureError {
 public:
  // R, G and B of two pictures over the same window.
  void add(const ColourImage& a, const ColourImage& b) {
    const Window& w = a.window();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double d = static_cast<double>(a.get(x, y, c)) - static_cast<double>(b.get(x, y, c));
          squares_ += d * d;
          largest_ = std::max(largest_, std::fabs(d));
        }
      }
    }
    samples_ += 3 * static_cast<std::int64_t>(w.pixels());
  }
  double rmse() const { return std::sqrt(squares_ / static_cast<double>(samples_)); }  // not of nothing
  double largest() const noexcept { return largest_; }

 private:
  double squares_ = 0, largest_ = 0;
  std::int64_t samples_ = 0;
};

// Of a peak of 1, dB.
inline double psnr(double rmse) { return rmse > 0 ? -20 * std::log10(rmse) : INFINITY; }

}  // namespace pullfocus::cli::bench
