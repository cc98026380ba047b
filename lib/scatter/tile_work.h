// Sources to scatter, by tile.
#pragma once

#include <span>
#include <vector>

#include "image/tiles.h"

namespace pullfocus {

// Tiles whose bookkeeping (not scatter) is too little to wake a thread for.
inline constexpr std::size_t kTilesTogether = 64;

struct TileWork {
  int tile = 0;       // position in the TileGrid
  int max_index = 0;  // no source of the mask, old or new, has a larger |index|
  TileMask mask;
};

// The tiles as they come, row by row, or column by column: then what a column of tiles reaches of a band stays in the
// second cache, where large kernels reach the same accumulators from many tile rows.
std::vector<const TileWork*> in_order(std::span<const TileWork> tiles, const TileGrid& grid, bool by_columns);

}  // namespace pullfocus
