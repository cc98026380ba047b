// A band of destination rows in the difference domain.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
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

// Rows of a band where kernels of up to `reach` rows write `span` of them, with so many layers and threads. Low bands
// stay in the caches, those of all layers together, and feed all threads evenly, but the lower they are, the more of
// them visit a source. There are as many for each thread. Measured: docs/benchmarks.md.
int band_height(int span, int reach, int layers, int threads, const BandLayout& layout) noexcept;

// Columns [x0, x1), x0 < x1.
struct ColumnSpan {
  int x0, x1;
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

  std::ptrdiff_t stride() const noexcept { return static_cast<std::ptrdiff_t>(stride_); }  // accumulators a row

  // Says that edges may fall on image columns [x0, x1) (pads included) of rows [ya, yb).
  void mark(int ya, int yb, int x0, int x1) noexcept;

  // Turns row y from changes into sums, folds the pads back in (or drops them), and says in which spans of image
  // columns it may be non-zero: disjoint and ascending. Elsewhere the row is zero.
  void finish_row(int y, std::vector<ColumnSpan>& spans);

  // Makes a finished row zero and clean again.
  void clear_row(int y, std::span<const ColumnSpan> spans) noexcept;

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

}  // namespace pullfocus
