// Sets of pixels, tile by tile.
#pragma once

#include <vector>

#include "image/window.h"
#include "scatter/tile_work.h"

namespace pullfocus {

inline TileGrid grid_of(const Window& window) noexcept { return {window.width(), window.height()}; }

// Calls visit(row of the tile, column of the tile, x, y) for every pixel of a tile's mask, rows top down; x, y from the
// window's corner.
template <typename Visit>
void for_each_tile_pixel(const TileGrid& grid, const TileWork& work, Visit&& visit) {
  for (int i = 0; i < kTileHeight; ++i) {
    for_each_pixel(work.mask.rows[i], [&](int p) { visit(i, p, grid.x(work.tile) + p, grid.y(work.tile) + i); });
  }
}

std::int64_t count_pixels(const std::vector<TileWork>& tiles) noexcept;

// The same pixels in grid order, each tile once.
std::vector<TileWork> merged(std::vector<TileWork> tiles);

// Pixels of `all` that are not in `some`; both in grid order.
std::vector<TileWork> without(const std::vector<TileWork>& all, const std::vector<TileWork>& some);

}  // namespace pullfocus
