// Depth as 16-bit keys that order as depth does. SIMD with run-time dispatch; every target gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "camera/depth.h"

namespace pullfocus {

// Nearer is smaller; depths whose keys are equal count as equal.
//   planar  exponent and ten bits of the mantissa, in steps of 1/2048 to 1/1024 of the depth, from 2^-33 scene units
//           (nearer depths share key 0) to 1e9, where the background begins
//   coc     the signed diameter, which grows with depth, in 1/64 px from -511 to 511
inline constexpr std::uint16_t kBackgroundKey = 0xffff;  // farther than any surface; also where nothing was committed

// Keys of n depths, 1 <= n <= 64.
void depth_keys(DepthKind kind, const float* depth, int n, std::uint16_t* keys) noexcept;

inline constexpr int kCellWidth = 16;

struct ValueRange {
  std::uint16_t least, most;
};
// Of kCellWidth values in each of `rows` >= 1 rows that lie `stride` values apart.
ValueRange range_of_cell(const std::uint16_t* values, std::ptrdiff_t stride, int rows) noexcept;

inline std::uint16_t depth_key(DepthKind kind, float depth) noexcept {
  std::uint16_t key = 0;
  depth_keys(kind, &depth, 1, &key);
  return key;
}

}  // namespace pullfocus
