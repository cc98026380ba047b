#include "importance/tile_sets.h"

#include <algorithm>
#include <numeric>

namespace pullfocus {

std::int64_t count_pixels(const std::vector<TileWork>& tiles) noexcept {
  return std::accumulate(tiles.begin(), tiles.end(), std::int64_t{0},
                         [](std::int64_t sum, const TileWork& work) { return sum + work.mask.count(); });
}

std::vector<TileWork> merged(std::vector<TileWork> tiles) {
  std::sort(tiles.begin(), tiles.end(), [](const TileWork& a, const TileWork& b) { return a.tile < b.tile; });
  std::vector<TileWork> result;
  for (const TileWork& work : tiles) {
    if (result.empty() || result.back().tile != work.tile) {
      result.push_back(work);
      continue;
    }
    for (int i = 0; i < kTileHeight; ++i) result.back().mask.rows[i] |= work.mask.rows[i];
    result.back().max_index = std::max(result.back().max_index, work.max_index);
  }
  return result;
}

std::vector<TileWork> without(const std::vector<TileWork>& all, const std::vector<TileWork>& some) {
  std::vector<TileWork> rest;
  auto minus = some.begin();
  for (TileWork work : all) {
    while (minus != some.end() && minus->tile < work.tile) ++minus;
    if (minus != some.end() && minus->tile == work.tile) {
      for (int i = 0; i < kTileHeight; ++i) work.mask.rows[i] &= ~minus->mask.rows[i];
    }
    if (work.mask.any()) rest.push_back(work);
  }
  return rest;
}

}  // namespace pullfocus
