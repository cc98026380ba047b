// Pixels of one layer, from sums to colours. SIMD with run-time dispatch; every target gives the same bits.
#pragma once

#include "image/frame.h"
#include "scatter/band.h"

namespace pullfocus {

// n pixels as resolve_span() gives them, `lanes` accumulators each. Returns false if one had no weight: what it was
// given means nothing.
bool divide(const Accumulator* values, int lanes, int n, SampleType type, void* pixels) noexcept;

}  // namespace pullfocus
