// A band of destination rows in the difference domain.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/aligned.h"

namespace pullfocus {

// Lanes of an accumulator: R, G, B, weight, and A where alpha is accumulated. Sums are kept modulo 2^64: only
// final sums must fit an int64, and those do by the bound KernelTable checks.
using Accumulator = std::uint64_t;
inline constexpr int kWeightLane = 3;
inline constexpr int kAlphaLane = 4;
inline constexpr int kOpaqueLanes = 4;
inline constexpr int kAlphaLanes = 5;

// Mirrors a coordinate into [0, size): -1 -> 0, size -> size - 1, any number of times. What a kernel loses
// past a border comes back this way, so that light neither leaks nor darkens there.
inline int mirror(int x, int size) noexcept {
  if (x >= 0 && x < size) return x;
  const int period = 2 * size;
  x %= period;
  if (x < 0) x += period;
  return x < size ? x : period - 1 - x;
}

struct BandLayout {
  int width = 0, height = 0;  // image
  int pad = 0;                // columns beyond each side that edges may fall on
  int lanes = kOpaqueLanes;
  bool fold = true;  // what falls on the pads comes back mirrored; else it is dropped
};

// Rows [y0, y1) of the image, each padded on both sides. Owned by one thread at a time.
class Band {
 public:
  static constexpr int kCell = 32;  // columns that are marked dirty together

  // All zero afterwards, nothing dirty. Keeps its memory.
  void begin(const BandLayout& layout, int y0, int y1);

  int y0() const noexcept { return y0_; }
  int y1() const noexcept { return y1_; }
  Accumulator* row(int y) noexcept {  // at column 0 of the image
    return values_.data() + static_cast<std::size_t>(y - y0_) * stride_ +
           static_cast<std::size_t>(layout_.pad) * static_cast<std::size_t>(layout_.lanes);
  }

  // Says that edges may fall on image columns [x0, x1) (pads included) of rows [ya, yb).
  void mark(int ya, int yb, int x0, int x1) noexcept;

  // Turns row y from changes into sums, folds the pads back in (or drops them), and hands every span of image columns
  // that may be non-zero to take(x0, x1, values), values pointing at column x0. Spans are disjoint and ascending. The
  // row is zero and clean when this returns.
  template <typename Take>
  void finish_row(int y, Take&& take);

 private:
  std::uint64_t* cells(int y) noexcept { return dirty_.data() + static_cast<std::size_t>(y - y0_) * words_; }
  void integrate(Accumulator* first, int columns) noexcept;
  void fold(Accumulator* image_row, int from, int to) noexcept;
  void clear(Accumulator* image_row, int from, int to) const noexcept {
    if (from >= to) return;
    std::fill_n(image_row + static_cast<std::ptrdiff_t>(from) * layout_.lanes,
                static_cast<std::size_t>(to - from) * static_cast<std::size_t>(layout_.lanes), Accumulator{0});
  }

  BandLayout layout_;
  int y0_ = 0, y1_ = 0;
  std::size_t stride_ = 0;  // accumulators per row
  std::size_t words_ = 0;   // of dirty bits per row
  std::vector<Accumulator, CacheAligned<Accumulator>> values_;
  std::vector<std::uint64_t> dirty_;
};

template <typename Take>
void Band::finish_row(int y, Take&& take) {
  std::uint64_t* const bits = cells(y);
  Accumulator* const image_row = row(y);
  const int cell_count = (layout_.width + 2 * layout_.pad + kCell - 1) / kCell;
  const auto is_dirty = [&](int cell) { return (bits[cell / 64] >> (cell % 64) & 1) != 0; };
  const int lanes = layout_.lanes;
  for (int cell = 0; cell < cell_count; ++cell) {
    if (!is_dirty(cell)) continue;
    int end = cell + 1;
    while (end < cell_count && is_dirty(end)) ++end;
    // Every source's footprint lies in one stretch of dirty cells, and so does its mirror image (a source at
    // x >= 0 that reaches down to x - r < 0 is mirrored to at most r - x - 1 < x + r): sums begin and end at
    // 0.
    const int from = cell * kCell - layout_.pad;
    const int to = std::min(end * kCell - layout_.pad, layout_.width + layout_.pad);
    integrate(image_row + static_cast<std::ptrdiff_t>(from) * lanes, to - from);
    if (layout_.fold) {
      fold(image_row, from, to);
    } else {
      clear(image_row, from, std::min(to, 0));
      clear(image_row, std::max(from, layout_.width), to);
    }
    const int x0 = std::max(from, 0), x1 = std::min(to, layout_.width);
    if (x0 < x1) {
      Accumulator* values = image_row + static_cast<std::ptrdiff_t>(x0) * lanes;
      take(x0, x1, static_cast<const Accumulator*>(values));
      clear(image_row, x0, x1);
    }
    cell = end;
  }
  std::fill_n(bits, words_, std::uint64_t{0});
}

}  // namespace pullfocus
