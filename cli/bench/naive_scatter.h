// The inner loops of the naive scatter: every pixel of every kernel, O(R^2) a source. SIMD with run-time dispatch, as
// wide as the processor has it, with fused multiply-add.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/aligned.h"

namespace pullfocus::cli::bench {

// In which order contributions are added, and how sums lie in memory. Either way vectors of sums are aligned, and those
// of weights are shifted to fit.
enum class Way {
  by_source,  // one source after the other; R, G, B, weight of a pixel, several pixels a vector, each weight in four
              // lanes
  by_row  // a few sources at a time, row by row of what they reach, which then stays in the innermost cache; a plane
          // a channel, rows of the four one after the other, weights as they lie
};

template <typename T>
using Aligned = std::vector<T, CacheAligned<T>>;

// A kernel as a table of weights; a row goes from its first weight above zero to its last.
template <typename Real>
struct NaiveKernel {
  // Zeros between rows, before the first and after the last, so that vectors may begin and end outside a row.
  static constexpr int kZeros = 16;
  struct Row {
    int dx, count;      // first column, relative to the source, and columns
    std::size_t first;  // of `weights`
  };
  int radius_y = 0;
  std::vector<Row> rows;  // 2 radius_y + 1
  Aligned<Real> weights;
};

// Destination rows [y0, y1) with room for what falls beyond either side.
template <typename Real>
struct NaiveBand {
  Real* sums;         // row y0, at the first column of the pad on the left; on a cache line
  std::size_t row;    // values from row to row, a multiple of a cache line
  std::size_t plane;  // by_row: values from channel to channel, likewise
  int pad;            // columns left of column 0, a multiple of kZeros
  int y0, y1;
};

// Adds the sources of row y, `width` pixels of R, G, B, 1 whose kernels are kernels[|index|], to the band.
template <typename Real>
void naive_scatter_row(Way way, const std::vector<NaiveKernel<Real>>& kernels, const std::int16_t* index,
                       const Real* colours, int width, int y, const NaiveBand<Real>& band);

}  // namespace pullfocus::cli::bench
