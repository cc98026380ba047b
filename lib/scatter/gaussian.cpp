#include "scatter/gaussian.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scatter/density.h"

namespace pullfocus {

namespace {

constexpr int kLevels = 16;
constexpr double kCut = 3;                                     // standard deviations
constexpr double kSigmaOfDiameter = 0.25 * 1.026275820971166;  // 1/4 / sqrt(1 - 4.5 e^-4.5 / (1 - e^-4.5))

// Means of exp(-x^2 / (2 sigma^2)) over the pixels 0, 1, ..., radius, relative to pixel 0.
std::vector<double> pixel_means(double sigma, int radius) {
  std::vector<double> means;
  const double scale = 1 / (sigma * std::sqrt(2.));
  for (int x = 0; x <= radius; ++x) means.push_back(std::erf((x + 0.5) * scale) - std::erf((x - 0.5) * scale));
  const double largest = means[0];
  for (double& mean : means) mean /= largest;
  return means;
}

}  // namespace

Kernel gaussian_kernel(double diameter_px, double pixel_aspect) {
  const double sigma_x = kSigmaOfDiameter * std::max(diameter_px, kMixBelow), sigma_y = sigma_x * pixel_aspect;
  Density density(kCut * sigma_x, kCut * sigma_y);
  const std::vector<double> across = pixel_means(sigma_x, density.rx()), down = pixel_means(sigma_y, density.ry());
  for (int dy = 0; dy <= density.ry(); ++dy) {
    for (int dx = 0; dx <= density.rx(); ++dx) {
      const double x = dx / sigma_x, y = dy / sigma_y;
      if (x * x + y * y > kCut * kCut) break;
      const double mean = across[static_cast<std::size_t>(dx)] * down[static_cast<std::size_t>(dy)];
      density.set_mirrored(dx, dy, static_cast<std::int32_t>(std::lrint(Density::kPeak * mean)));
    }
  }
  return kernel_from_density(density, level_borders(density, kLevels, Spacing::two_thirds), diameter_px);
}

}  // namespace pullfocus
