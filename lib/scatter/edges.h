// Writing groups of neighbouring sources that share a kernel into a band, as run edges. SIMD with run-time dispatch;
// every target gives the same bits.
#pragma once

#include <cstdint>

#include "image/tiles.h"
#include "scatter/band.h"
#include "scatter/kernel.h"

namespace pullfocus {

// One source: contribution at weight w is round(plus * w) - round(minus * w), lane by lane.
template <int lanes>
struct Emission {
  int x;               // image column
  std::int16_t index;  // whose kernel
  double plus[lanes], minus[lanes];
};

// A band as kernels see it: kernel rows Y in [y0, y1) land on band row `first + (Y - y0) * direction`. The
// band itself, and its mirror images past the top and bottom border that kernels still reach. Light comes back from
// there as if the picture went on mirrored, every source with its kernel as it is: seen from the source, the kernel's
// rows run backwards where `direction` is -1.
struct BandImage {
  int y0, y1;
  int first, direction;

  int band_row(int y) const noexcept { return first + (y - y0) * direction; }
};

// Columns that are written together, at most.
inline constexpr int kWindow = 8;

// Writes the sources[i] with bit i of `members` set, whose kernel this is and which lie in columns x .. x + width - 1
// of row y, into the band rows of one of its images. Columns without a member are written as zeros.
template <int lanes>
using WriteGroup = void (*)(const Kernel& kernel, const Emission<lanes>* sources, std::uint32_t members, int x, int y,
                            const BandImage& image, Band& band);

// For the processor at hand.
template <int lanes>
struct GroupWriters {
  WriteGroup<lanes> by_width[4];  // 1, 2, 4 and kWindow columns

  // The narrowest writer for a group of so many columns.
  WriteGroup<lanes> writer(int width) const noexcept {
    return by_width[width <= 1 ? 0 : width <= 2 ? 1 : width <= 4 ? 2 : 3];
  }
};

// `with_minus`: false if every `minus` is to be taken as 0.
template <int lanes>
GroupWriters<lanes> group_writers(bool with_minus) noexcept;

}  // namespace pullfocus
