#include "scatter/state.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace pullfocus {

namespace {

const std::int16_t* row_of(const SourceState& state, int y) noexcept {
  return state.index.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(state.colour.window().width());
}

}  // namespace

std::vector<TileWork> whole_state(const SourceState& state) {
  const TileGrid grid{state.colour.window().width(), state.colour.window().height()};
  std::vector<TileWork> tiles(static_cast<std::size_t>(grid.count()));
  tbb::parallel_for(0, grid.count(), [&](int tile) {
    TileWork& work = tiles[static_cast<std::size_t>(tile)];
    work.tile = tile;
    for (int i = 0; i < grid.tile_height(tile); ++i) {
      const std::int16_t* index = row_of(state, grid.y(tile) + i) + grid.x(tile);
      if (grid.tile_width(tile) == kTileWidth) {
        const IndexBounds bounds = bounds_of_tile_row(index);
        if (is_source(static_cast<std::int16_t>(bounds.least))) {
          work.mask.rows[i] = first_pixels(kTileWidth);
          work.max_index = std::max(work.max_index, bounds.largest());
          continue;
        }
      }
      for (int p = 0; p < grid.tile_width(tile); ++p) {
        if (index[p] == kNeverCommitted) continue;
        work.mask.rows[i] |= std::uint64_t{1} << p;
        work.max_index = std::max(work.max_index, reach_index(index[p]));
      }
    }
  });
  std::erase_if(tiles, [](const TileWork& work) { return !work.mask.any(); });
  return tiles;
}

}  // namespace pullfocus
