#include "scatter/aperture_image.h"

#include <algorithm>
#include <cmath>

#include "scatter/density.h"

namespace pullfocus {

namespace {

constexpr int kLevels = 16;

}  // namespace

ApertureImage::ApertureImage(const AperturePicture& picture) : width_(picture.width), height_(picture.height) {
  const float brightest = *std::max_element(picture.luminance.begin(), picture.luminance.end());
  const auto columns = static_cast<std::size_t>(width_) + 1;
  sums_.resize(columns * (static_cast<std::size_t>(height_) + 1));
  const float* luminance = picture.luminance.data();
  for (std::size_t y = 1; y <= static_cast<std::size_t>(height_); ++y) {
    std::int64_t row = 0;
    for (std::size_t x = 1; x < columns; ++x) {
      row += std::lrint(static_cast<double>(*luminance++) / static_cast<double>(brightest) * Density::kPeak);
      sums_[y * columns + x] = sums_[(y - 1) * columns + x] + row;
    }
  }
}

double ApertureImage::integral(double x, double y) const noexcept {
  x = std::clamp(x, 0., static_cast<double>(width_));
  y = std::clamp(y, 0., static_cast<double>(height_));
  const int xi = std::min(static_cast<int>(x), width_ - 1), yi = std::min(static_cast<int>(y), height_ - 1);
  const auto columns = static_cast<std::size_t>(width_) + 1;
  const std::int64_t* corner = &sums_[static_cast<std::size_t>(yi) * columns + static_cast<std::size_t>(xi)];
  const double fx = x - xi, fy = y - yi;
  const auto value = [&](std::size_t offset) { return static_cast<double>(corner[offset]); };
  return (1 - fy) * ((1 - fx) * value(0) + fx * value(1)) + fy * ((1 - fx) * value(columns) + fx * value(columns + 1));
}

Kernel ApertureImage::kernel(double diameter_px, double pixel_aspect) const {
  const double scale = std::max(width_, height_) / std::max(diameter_px, kMixBelow);  // picture pixels a pixel
  const double scale_y = scale / pixel_aspect;
  Density density(width_ / scale / 2, height_ / scale_y / 2);
  for (int dy = -density.ry(); dy <= density.ry(); ++dy) {
    const double y0 = height_ / 2. + (dy - 0.5) * scale_y, y1 = height_ / 2. + (dy + 0.5) * scale_y;
    for (int dx = -density.rx(); dx <= density.rx(); ++dx) {
      const double x0 = width_ / 2. + (dx - 0.5) * scale, x1 = width_ / 2. + (dx + 0.5) * scale;
      const double sum = integral(x1, y1) - integral(x0, y1) - integral(x1, y0) + integral(x0, y0);
      density.at(dx, dy) = static_cast<std::int32_t>(std::lrint(std::max(0., sum) / (scale * scale_y)));
    }
  }
  return kernel_from_density(density, level_borders(density, kLevels, Spacing::even), diameter_px);
}

}  // namespace pullfocus
