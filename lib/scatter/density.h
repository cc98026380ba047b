// From the mean density of an intensity distribution over every pixel to a kernel of few levels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scatter/kernel.h"

namespace pullfocus {

inline constexpr double kMixBelow = 2;  // px of diameter: smaller kernels are mixed with the identity

// Mean densities over the pixels' squares, in whole numbers, so that what is built from them is the same on every
// machine even where a library function differs in its last bit.
class Density {
 public:
  static constexpr std::int32_t kPeak = 1 << 16;  // guide value for the largest density

  // Holds everything within the half extents, in pixels.
  Density(double half_width, double half_height);

  int rx() const noexcept { return rx_; }
  int ry() const noexcept { return ry_; }
  std::int32_t& at(int dx, int dy) noexcept { return values_[index(dx, dy)]; }  // >= 0, <= 2^17
  const std::vector<std::int32_t>& values() const noexcept { return values_; }

  // Writes one value to (+-dx, +-dy).
  void set_mirrored(int dx, int dy, std::int32_t value) noexcept {
    at(dx, dy) = at(-dx, dy) = at(dx, -dy) = at(-dx, -dy) = value;
  }

 private:
  std::size_t index(int dx, int dy) const noexcept {
    return static_cast<std::size_t>(dy + ry_) * static_cast<std::size_t>(2 * rx_ + 1) +
           static_cast<std::size_t>(dx + rx_);
  }
  int rx_, ry_;
  std::vector<std::int32_t> values_;
};

// How levels are spaced over the densities from 0 to the largest: evenly, or evenly in density^(2/3), which spends more
// of them on faint parts that cover much area (the spacing of least square error where area goes as 1/density, as in a
// gaussian; Panter and Dite 1951).
enum class Spacing { even, two_thirds };

// Ascending densities from which on levels 1, 2, ... begin: half-way between levels. `levels` in 1..16.
std::vector<std::int32_t> level_borders(const Density& density, int levels, Spacing spacing);

// A kernel of at most as many weights as there are borders (1 to 16 of them, > 0). Pixels below the first border get
// none; all others the mean density of their level, so that quantising neither adds nor moves weight between levels. If
// no more densities than levels occur they are kept as they are. Below kMixBelow the density must be that of diameter
// kMixBelow: the kernel is mixed with the identity, share (D / 2)^2, so that blur sets in smoothly and its second
// moment grows as D^2. A density that is nowhere above the first border gives the identity.
Kernel kernel_from_density(const Density& density, const std::vector<std::int32_t>& borders, double diameter_px);

}  // namespace pullfocus
