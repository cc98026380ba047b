// A few pixels of several layers, from sums to colours. SIMD with run-time dispatch; every target gives the same bits.
#pragma once

#include <cstddef>
#include <span>

#include "image/frame.h"
#include "resolve/backdrop.h"
#include "scatter/band.h"

namespace pullfocus {

// n <= Backdrop::kChunk pixels as resolve_layers() gives them, from layers that all have sums there, the first `near`
// in front of focus. `chunk`, if not null, is told what the backdrop is to know of them. Returns false if a pixel had
// no weight: what it was given means nothing.
bool compose(std::span<const Accumulator* const> layers, std::size_t near, int lanes, int n, SampleType type,
             void* pixels, Backdrop::Chunk* chunk) noexcept;

}  // namespace pullfocus
