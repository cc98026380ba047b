// A few pixels of a row, from sums to colours. SIMD with run-time dispatch; every target gives the same bits.
#pragma once

#include <span>

#include "image/frame.h"
#include "resolve/backdrop.h"
#include "scatter/band.h"

namespace pullfocus {

// n pixels as resolve_span() gives them, `lanes` accumulators each. Returns false if one had no weight: what it was
// given means nothing.
bool divide(const Accumulator* values, int lanes, int n, SampleType type, void* pixels) noexcept;

// n <= Backdrop::kChunk pixels as resolve_layers() gives them, from layers that all have sums there, the first `near`
// in front of focus. `chunk`, if not null, is told what the backdrop is to know of them. Returns false as divide()
// does.
bool compose(std::span<const Accumulator* const> layers, std::size_t near, int lanes, int n, SampleType type,
             void* pixels, Backdrop::Chunk* chunk) noexcept;

}  // namespace pullfocus
