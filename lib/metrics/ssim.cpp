#include "metrics/ssim.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "metrics/convolve.h"
#include "metrics/planes.h"

namespace pullfocus {

namespace {

constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Grid product(const Grid& a, const Grid& b) {
  Grid out(a.window);
  std::ranges::transform(a.values, b.values, out.values.begin(), std::multiplies<>());
  return out;
}

Taps gaussian() {
  Taps taps = make_taps(kSsimRadius, [](double x) { return std::exp(-x * x / (2 * 1.5 * 1.5)); });
  double sum = 0;
  for (const double tap : taps) sum += tap;
  for (double& tap : taps) tap /= sum;
  return taps;
}

}  // namespace

Plane ssim_map(const ColourImage& picture, const ColourImage& reference, const Window& window) {
  require_pixels(window);
  const Grid a = display_luma(picture, window), b = display_luma(reference, window);
  const Taps g = gaussian();
  const auto smooth = [&](const Grid& plane) { return correlate(plane, g, g); };
  const Grid mean_a = smooth(a), mean_b = smooth(b);
  const Grid aa = smooth(product(a, a)), bb = smooth(product(b, b)), ab = smooth(product(a, b));
  Plane map(window, 0);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const double ma = mean_a.at(x, y), mb = mean_b.at(x, y);
      const double variance_a = aa.at(x, y) - ma * ma;
      const double variance_b = bb.at(x, y) - mb * mb;
      const double covariance = ab.at(x, y) - ma * mb;
      map.at(x, y) = static_cast<float>((2 * ma * mb + kC1) * (2 * covariance + kC2) /
                                        ((ma * ma + mb * mb + kC1) * (variance_a + variance_b + kC2)));
    }
  }
  return map;
}

double ssim(const ColourImage& picture, const ColourImage& reference, const Window& window) {
  const Plane map = ssim_map(picture, reference, window);
  const Window inner = grow(window, -kSsimRadius, -kSsimRadius);
  return mean(map, inner.empty() ? window : inner);
}

}  // namespace pullfocus
