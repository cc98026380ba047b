// Ranks of changed pixels, tile by tile: of blocks where pixels are judged together (see order.h), of single pixels
// elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "importance/order.h"
#include "importance/tile_keys.h"
#include "importance/tile_sets.h"

namespace pullfocus {

// A unit is a pixel, or the pixels of a block that are judged together, which rank by the mean of their priorities.
class TileRanks {
 public:
  // Runs in the calling task arena; the ranks do not depend on its threads. `tiles` must outlive this.
  TileRanks(const std::vector<TileWork>& tiles, const Pending& pending, const ImportanceOptions& options);

  // By position in `tiles`: every changed pixel's rank, its unit's; larger comes first.
  const std::vector<TileKeys>& ranks() const noexcept { return ranks_; }
  bool any_never_committed() const noexcept { return !never_.empty(); }
  const TileMask& never_committed(std::size_t tile) const noexcept { return never_[tile]; }  // where there are any

  // Differ from call to call; a pixel's unit's, and its own.
  std::uint32_t scrambled_unit(std::size_t tile, int row, int column) const noexcept {
    const bool in_block = by_block_[tile].rows[row] >> column & 1;
    return scrambled_position(tile, in_block ? block(row, column) : row * kTileWidth + column);
  }
  std::uint32_t scrambled_pixel(std::size_t tile, int row, int column) const noexcept {
    return scrambled_position(tile, row * kTileWidth + column);
  }

 private:
  static constexpr int kPixels = kTileWidth * kTileHeight, kBlocksAcross = kTileWidth / kBlockWidth;

  // Blocks are numbered after the pixels.
  static int block(int row, int column) noexcept {
    return kPixels + row / kBlockHeight * kBlocksAcross + column / kBlockWidth;
  }
  std::uint32_t scrambled_position(std::size_t tile, int unit) const noexcept {
    return scrambled((static_cast<std::uint32_t>(tiles_[tile].tile) << 11 | static_cast<std::uint32_t>(unit)) ^ round_);
  }
  void rank_tile(std::size_t tile, const TileGrid& grid, const Priorities& priorities);

  const std::vector<TileWork>& tiles_;
  const std::uint32_t round_;
  const bool buckets_;
  std::vector<TileKeys> ranks_;
  std::vector<TileMask> by_block_, never_;
};

}  // namespace pullfocus
