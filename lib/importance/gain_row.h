// Order::gain (see order.h) of the pixels of a tile row: arithmetic alone. SIMD with run-time dispatch; every target
// gives the same bits.
#pragma once

#include <cstdint>

#include "image/sanitise.h"
#include "image/tiles.h"

namespace pullfocus {

struct PlanarRow {
  alignas(64) float channel[3][kTileWidth];
};

// Channels of n <= kTileWidth pixels, one after the other.
void to_planes(const Pixel<SampleType::half>* pixels, int n, PlanarRow& out) noexcept;
void to_planes(const Pixel<SampleType::float32>* pixels, int n, PlanarRow& out) noexcept;

struct GainRow {
  PlanarRow now, then, shown;               // of the frame, of the committed state, of the last result
  alignas(64) std::int16_t is[kTileWidth];  // signed indices of now
  std::int16_t was[kTileWidth];             // and of then
  float of_block[kTileWidth];               // random numbers of [0, 1): each pixel's block's
  const float* areas;                       // 1 / A by |index|
  std::uint32_t first;                      // position of the first pixel; that of the next one is one more
};

// Writes the priorities of n pixels. Returns those that are judged as blocks, bit i of pixel i.
std::uint64_t gains(const GainRow& row, int n, float* out) noexcept;

// In [0, 1).
inline float fraction_of(std::uint32_t scrambled) noexcept { return 0x1p-24f * static_cast<float>(scrambled >> 8); }

}  // namespace pullfocus
