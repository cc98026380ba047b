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

// Of the blocks of kBlockHeight rows of a tile, from row `top` on.
void rank_blocks(int top, const float (&of)[kBlockHeight][kTileWidth], const TileMask& by_block, TileKeys& ranks) {
  std::uint64_t any = 0;
  for (int k = 0; k < kBlockHeight; ++k) any |= by_block.rows[top + k];
  while (any != 0) {
    const int column = std::countr_zero(any) / kBlockWidth * kBlockWidth;
    const std::uint64_t block = first_pixels(kBlockWidth) << column;
    any &= ~block;
    double sum = 0;
    int pixels = 0;
    for (int k = 0; k < kBlockHeight; ++k) {
      for_each_pixel(by_block.rows[top + k] & block, [&](int p) {
        sum += static_cast<double>(of[k][p]);
        ++pixels;
      });
    }
    const std::uint16_t rank = rank_of(static_cast<float>(sum / pixels));
    for (int k = 0; k < kBlockHeight; ++k) {
      for_each_pixel(by_block.rows[top + k] & block, [&](int p) { ranks.of[top + k][p] = rank; });
    }
  }
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
  TileMask& by_block = by_block_[tile];
  float of[kBlockHeight][kTileWidth];
  for (int i = 0; i < kTileHeight; ++i) {
    const std::uint64_t row = work.mask.rows[i];
    if (row != 0) {
      const int first = std::countr_zero(row), n = static_cast<int>(std::bit_width(row)) - first;
      float* const of_row = of[i % kBlockHeight] + first;
      by_block.rows[i] = row & priorities.row(grid.x(work.tile) + first, grid.y(work.tile) + i, n, of_row) << first;
      std::uint16_t* const out = ranks_[tile].of[i] + first;
      if (buckets_) {
        std::transform(of_row, of_row + n, out, [](float bucket) { return static_cast<std::uint16_t>(bucket); });
      } else {
        std::transform(of_row, of_row + n, out, rank_of);
      }
    }
    if (i % kBlockHeight == kBlockHeight - 1) rank_blocks(i + 1 - kBlockHeight, of, by_block, ranks_[tile]);
  }
}

}  // namespace pullfocus
