// What decides occlusion, of every committed pixel: its depth key and the size of its CoC.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scatter/band.h"

namespace pullfocus {

// Two uint16 planes whose rows go on mirrored past both borders, so that a run of columns around a pixel is one read.
class DepthPlanes {
 public:
  static constexpr int kMirrored = 32;  // columns beyond each border: half the largest bitmap
  static constexpr int kMargin = 96;    // that may be read: as much again from there, and a vector

  // Background everywhere: it hides nothing.
  void reset(int width, int height);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

  // At column 0; columns -kMargin .. width + kMargin - 1 may be read, and mean something up to kMirrored beyond.
  std::uint16_t* keys(int y) noexcept { return keys_.data() + offset(y); }
  const std::uint16_t* keys(int y) const noexcept { return keys_.data() + offset(y); }
  std::uint16_t* sizes(int y) noexcept { return sizes_.data() + offset(y); }  // |CoC index|
  const std::uint16_t* sizes(int y) const noexcept { return sizes_.data() + offset(y); }

  std::ptrdiff_t stride() const noexcept { return width_ + 2 * kMargin; }  // values from row to row
  std::size_t bytes() const noexcept { return (keys_.size() + sizes_.size()) * sizeof keys_[0]; }

  void mirror_margins(int y) noexcept;  // after columns of the row have changed

 private:
  std::size_t offset(int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 2 * kMargin) + kMargin;
  }
  int width_ = 0, height_ = 0;
  std::vector<std::uint16_t> keys_, sizes_;
};

}  // namespace pullfocus
