#include "scatter/tile_work.h"

#include <algorithm>

namespace pullfocus {

std::vector<const TileWork*> in_order(std::span<const TileWork> tiles, const TileGrid& grid, bool by_columns) {
  std::vector<const TileWork*> order;
  order.reserve(tiles.size());
  for (const TileWork& work : tiles) order.push_back(&work);
  if (by_columns) {
    std::stable_sort(order.begin(), order.end(),
                     [&](const TileWork* a, const TileWork* b) { return grid.x(a->tile) < grid.x(b->tile); });
  }
  return order;
}

}  // namespace pullfocus
