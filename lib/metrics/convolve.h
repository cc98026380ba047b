// Separable filters over planes.
#pragma once

#include <functional>
#include <vector>

#include "image/window.h"

namespace pullfocus {

// A plane of doubles: differences of means of squares need them. Rows top down, no padding.
struct Grid {
  Window window;
  std::vector<double> values;

  explicit Grid(const Window& w = {}) : window(w), values(w.pixels()) {}
  double* row(int y) noexcept { return values.data() + offset(y); }  // first value at x = window.x0
  const double* row(int y) const noexcept { return values.data() + offset(y); }
  double& at(int x, int y) noexcept { return row(y)[x - window.x0]; }
  double at(int x, int y) const noexcept { return row(y)[x - window.x0]; }

 private:
  std::size_t offset(int y) const noexcept {
    return static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width());
  }
};

// 2 radius + 1 taps, the middle one at offset 0.
using Taps = std::vector<double>;

// taps[i] = weight(i - radius).
Taps make_taps(int radius, const std::function<double(double)>& weight);

// out(x, y) = sum over i, j of across[i] down[j] in(x + i, y + j), offsets from the middle; the border's pixels go on
// outside the window. Cost per pixel: the number of taps of both. Runs on the calling arena's threads; the result does
// not depend on their number.
Grid correlate(const Grid& in, const Taps& across, const Taps& down);

}  // namespace pullfocus
