// Of kTileWidth signed indices side by side: which lie in a range, and how far they reach. SIMD with run-time dispatch;
// every target gives the same bits.
#pragma once

#include <cstdint>

#include "image/tiles.h"

namespace pullfocus {

// Bit i: first <= index[i] <= last.
std::uint64_t within(const std::int16_t* index, std::int16_t first, std::int16_t last) noexcept;

// The largest |index| of the pixels `mask`, all of which are sources; 0 if there are none.
int largest_of(const std::int16_t* index, std::uint64_t mask) noexcept;

}  // namespace pullfocus
