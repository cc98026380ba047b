// Keys of a tile's pixels, and the pixels whose keys lie in a range. SIMD with run-time dispatch.
#pragma once

#include <cstdint>

#include "image/tiles.h"

namespace pullfocus {

// Any numbers, row by row from the tile's top left corner.
struct TileKeys {
  static constexpr unsigned kMost = 0xffff;

  alignas(64) std::uint16_t of[kTileHeight][kTileWidth] = {};
};

// Pixels of `mask` whose keys are at least `least` and at most `most`; none if least > most.
TileMask within(const TileKeys& keys, const TileMask& mask, unsigned least, unsigned most) noexcept;

}  // namespace pullfocus
