// Sources to scatter, by tile.
#pragma once

#include <cstddef>

#include "image/tiles.h"

namespace pullfocus {

// Tiles whose bookkeeping (not scatter) is too little to wake a thread for.
inline constexpr std::size_t kTilesTogether = 64;

struct TileWork {
  int tile = 0;       // position in the TileGrid
  int max_index = 0;  // no source of the mask, old or new, has a larger |index|
  TileMask mask;
};

}  // namespace pullfocus
