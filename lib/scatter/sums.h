// Runs of accumulators, modulo 2^64. SIMD with run-time dispatch.
#pragma once

#include <cstddef>

#include "scatter/band.h"

namespace pullfocus {

// Replaces every column, `lanes` (kOpaqueLanes or kAlphaLanes) accumulators, by the sum of all columns up to it.
void prefix_sum(Accumulator* values, int columns, int lanes) noexcept;

// sums[i] += values[i] for i in [0, n). No overlap.
void add_sums(const Accumulator* values, std::size_t n, Accumulator* sums) noexcept;

}  // namespace pullfocus
