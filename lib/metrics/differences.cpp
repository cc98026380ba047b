#include "metrics/differences.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/error.h"
#include "metrics/planes.h"

namespace pullfocus {

namespace {

constexpr double kRelativeFloor = 0.01;

double sample(const ColourImage& picture, int x, int y, int channel) noexcept {
  return picture.window().contains(x, y) ? static_cast<double>(picture.get(x, y, channel)) : 0;
}

double minus(double a, double b) noexcept { return a == b ? 0 : a - b; }

double shown(double value, double peak) noexcept { return value > 0 ? std::min(value, peak) : 0; }

// A NaN, once met, stays.
double larger(double a, double b) noexcept { return a >= b || std::isnan(a) ? a : b; }

}  // namespace

double Differences::rmse() const noexcept { return std::sqrt(mse); }

double Differences::psnr(double peak) const noexcept {
  return shown_mse == 0 ? std::numeric_limits<double>::infinity() : 10 * std::log10(peak * peak / shown_mse);
}

Differences differences(const ColourImage& picture, const ColourImage& reference, const Window& window, double peak) {
  require_pixels(window);
  if (!(peak > 0) || !std::isfinite(peak)) throw Error(ErrorCode::usage, "the peak of PSNR must be greater than 0");
  Differences total;
  for (int y = window.y0; y < window.y1; ++y) {
    Differences row;
    for (int x = window.x0; x < window.x1; ++x) {
      for (int c = 0; c < 4; ++c) {
        const double a = sample(picture, x, y, c), b = sample(reference, x, y, c), d = minus(a, b);
        row.largest = larger(row.largest, std::fabs(d));
        if (c == 3) continue;
        row.mse += d * d;
        row.relative_mse += d == 0 ? 0 : d * d / (b * b + kRelativeFloor);
        const double s = shown(a, peak) - shown(b, peak);
        row.shown_mse += s * s;
      }
    }
    total.mse += row.mse;
    total.relative_mse += row.relative_mse;
    total.shown_mse += row.shown_mse;
    total.largest = larger(total.largest, row.largest);
  }
  const double samples = 3 * static_cast<double>(window.pixels());
  total.mse /= samples;
  total.relative_mse /= samples;
  total.shown_mse /= samples;
  return total;
}

Plane difference_map(const ColourImage& picture, const ColourImage& reference, const Window& window) {
  require_pixels(window);
  Plane map(window, 0);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = minus(sample(picture, x, y, c), sample(reference, x, y, c));
        sum += d * d;
      }
      map.at(x, y) = static_cast<float>(std::sqrt(sum / 3));
    }
  }
  return map;
}

}  // namespace pullfocus
