// Quantisation of the signed circle of confusion: diameters in pixels to signed table indices and back.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace pullfocus {

// Table diameters grow by `smallest_step` (half a pixel) up to the diameter where `coc_step` times it exceeds that, and
// by coc_step times the diameter beyond (the blurriest pixels cost most and are the least sensitive). Index 0 is
// diameter 0; negative indices are in front of focus and share the diameter of their positive twin.
class CocTable {
 public:
  static constexpr float kCellsPerPixel = 8;  // resolution of the look-up: index borders lie on 1/8 px
  static constexpr double kMaxDiameter = 500;

  // coc_step in [0, 1]; max_coc_px in [1, kMaxDiameter], the largest diameter, to which larger ones are
  // clamped; smallest_step in [1/8, 1/2] pixels, for measuring what steps cost. Throws Error(usage) naming --coc-step
  // or --max-coc.
  CocTable(double coc_step, double max_coc_px, double smallest_step = 0.5);

  int size() const noexcept { return static_cast<int>(diameters_.size()); }  // indices -(size-1) .. size-1
  double diameter(int index) const noexcept { return diameters_[static_cast<std::size_t>(std::abs(index))]; }
  double signed_diameter(int index) const noexcept { return std::copysign(diameter(index), index); }
  float max_diameter() const noexcept { return max_diameter_; }

  // Nearest table index of a signed diameter in pixels; |c| beyond the largest, and NaN, count as the
  // largest.
  std::int16_t index(float c) const noexcept {
    const float size = std::fabs(c);
    const auto cell = static_cast<std::size_t>((size < max_diameter_ ? size : max_diameter_) * kCellsPerPixel);
    const std::int32_t magnitude = cells_[cell];
    return static_cast<std::int16_t>(c < 0 ? -magnitude : magnitude);
  }

  // |index| by |diameter| in eighths of a pixel, rounded down; as wide as vectors gather.
  const std::int32_t* cells() const noexcept { return cells_.data(); }

 private:
  float max_diameter_;
  std::vector<double> diameters_;
  std::vector<std::int32_t> cells_;
};

}  // namespace pullfocus
