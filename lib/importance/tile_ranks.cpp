#include "importance/tile_ranks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace pullfocus {

namespace {

std::vector<TileMask> never_committed(const std::vector<TileWork>& tiles, const Pending& pending) {
  const std::vector<std::int16_t>& index = pending.state.index;
  if (std::find(index.begin(), index.end(), kNeverCommitted) == index.end()) return {};
  const TileGrid grid = grid_of(pending.frame.window());
  std::vector<TileMask> never(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for_each_tile_pixel(grid, tiles[t], [&](int row, int p, int x, int y) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
      never[t].rows[row] |= std::uint64_t{index[at] == kNeverCommitted} << p;
    });
  }
  return never;
}

// Bits of floats >= 0 order as the floats do: eight of the exponent, seven of the mantissa.
std::uint16_t rank_of(float priority) noexcept {
  return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(priority) >> 16);
}

}  // namespace

TileRanks::TileRanks(const std::vector<TileWork>& tiles, const Pending& pending, const ImportanceOptions& options)
    : tiles_(tiles),
      round_(scrambled(pending.round)),
      buckets_(options.order != Order::gain),
      ranks_(tiles.size()),
      by_block_(tiles.size()),
      never_(pullfocus::never_committed(tiles, pending)) {
  const TileGrid grid = grid_of(pending.frame.window());
  const Priorities priorities(pending, options);
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) { rank_tile(t, grid, priorities); });
}

void TileRanks::rank_tile(std::size_t tile, const TileGrid& grid, const Priorities& priorities) {
  const TileWork& work = tiles_[tile];
  std::uint16_t* const out = ranks_[tile].of;
  float of_row[kTileWidth];
  double sum[kBlocksAcross] = {};
  int pixels[kBlocksAcross] = {};
  for (int i = 0; i < kTileHeight; ++i) {
    const std::uint64_t row = work.mask.rows[i];
    if (row != 0) {
      const int first = std::countr_zero(row), n = static_cast<int>(std::bit_width(row)) - first;
      const std::uint64_t in_blocks =
          row & priorities.row(grid.x(work.tile) + first, grid.y(work.tile) + i, n, of_row + first) << first;
      by_block_[tile].rows[i] = in_blocks;
      for_each_pixel(row & ~in_blocks, [&](int p) {
        out[i * kTileWidth + p] = buckets_ ? static_cast<std::uint16_t>(of_row[p]) : rank_of(of_row[p]);
      });
      for_each_pixel(in_blocks, [&](int p) {
        sum[p / kBlockWidth] += static_cast<double>(of_row[p]);
        ++pixels[p / kBlockWidth];
      });
    }
    if (i % kBlockHeight != kBlockHeight - 1) continue;
    for (int b = 0; b < kBlocksAcross; ++b) {
      if (pixels[b] > 0) out[block(i, b * kBlockWidth)] = rank_of(static_cast<float>(sum[b] / pixels[b]));
      sum[b] = pixels[b] = 0;
    }
  }
}

}  // namespace pullfocus
