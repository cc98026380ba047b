// Runs of accumulators, modulo 2^64. SIMD with run-time dispatch.
#pragma once

#include <algorithm>
#include <cstddef>

#include "scatter/band.h"

namespace pullfocus {

// Replaces every column, `lanes` (kOpaqueLanes or kAlphaLanes) accumulators, by the sum of all columns up to it.
void prefix_sum(Accumulator* values, int columns, int lanes) noexcept;

// sums[i] += values[i] for i in [0, n). No overlap.
void add_sums(const Accumulator* values, std::size_t n, Accumulator* sums) noexcept;

// sums[i] = values[i]. No overlap.
inline void copy_sums(const Accumulator* values, std::size_t n, Accumulator* sums) noexcept {
  std::copy_n(values, n, sums);
}

// The same, without reading what was there before and without leaving it in the caches. `sums` begins on a cache line.
// Other threads see it for certain only after finish_copies() of the thread that wrote it.
void copy_sums_past_caches(const Accumulator* values, std::size_t n, Accumulator* sums) noexcept;
void finish_copies() noexcept;

}  // namespace pullfocus
