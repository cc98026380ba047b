// Asking for memory ahead of time.
#pragma once

#include <cstddef>

#include "simd/aligned.h"

namespace pullfocus {

// Has lines of `bytes` from `address` on fetched into the second-level cache, one every `step` bytes: into the first,
// too few can be waited for at once. May reach past the end of what is allocated.
inline void prefetch(const void* address, std::size_t bytes, std::size_t step) noexcept {
  for (std::size_t b = 0; b < bytes; b += step) __builtin_prefetch(static_cast<const std::byte*>(address) + b, 0, 2);
  asm volatile("");  // or calls of functions that do nothing else are taken to be without effect, and left out
}

}  // namespace pullfocus
