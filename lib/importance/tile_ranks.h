// Ranks of changed pixels, tile by tile: of blocks where pixels are judged together (see order.h), of single pixels
// elsewhere.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "importance/order.h"
#include "importance/tile_sets.h"

namespace pullfocus {

// Units of a tile are its pixels, rows top down, and after them its blocks, which rank by the mean of the priorities of
// those of their pixels that are judged as blocks.
class TileRanks {
 public:
  static constexpr std::size_t kRanks = 1 << 15;

  // Runs in the calling task arena; the ranks do not depend on its threads. `tiles` must outlive this.
  TileRanks(const std::vector<TileWork>& tiles, const Pending& pending, const ImportanceOptions& options);

  // visit(unit, number of its pixels in the mask) for every unit that has any.
  template <typename Visit>
  void for_each_unit(std::size_t tile, const TileMask& mask, Visit&& visit) const {
    const TileMask& by_block = by_block_[tile];
    for (int i = 0; i < kTileHeight; i += kBlockHeight) {
      std::uint64_t in_blocks = 0;
      for (int k = i; k < i + kBlockHeight; ++k) {
        for_each_pixel(mask.rows[k] & ~by_block.rows[k], [&](int p) { visit(k * kTileWidth + p, 1); });
        in_blocks |= mask.rows[k] & by_block.rows[k];
      }
      for (; in_blocks != 0; in_blocks &= ~block_columns(std::countr_zero(in_blocks))) {
        const int p = std::countr_zero(in_blocks);
        int pixels = 0;
        for (int k = i; k < i + kBlockHeight; ++k) {
          pixels += std::popcount(mask.rows[k] & by_block.rows[k] & block_columns(p));
        }
        visit(block(i, p), pixels);
      }
    }
  }

  // The unit that a pixel belongs to.
  int unit(std::size_t tile, int row, int column) const noexcept {
    return by_block_[tile].rows[row] >> column & 1 ? block(row, column) : row * kTileWidth + column;
  }

  // Adds a unit's pixels of `from`.
  void add(std::size_t tile, int unit, const TileMask& from, TileMask& to) const noexcept {
    if (unit < kPixels) {
      const int row = unit / kTileWidth;
      to.rows[row] |= from.rows[row] & std::uint64_t{1} << unit % kTileWidth;
      return;
    }
    const int row = (unit - kPixels) / kBlocksAcross * kBlockHeight,
              column = (unit - kPixels) % kBlocksAcross * kBlockWidth;
    for (int k = row; k < row + kBlockHeight; ++k) {
      to.rows[k] |= from.rows[k] & by_block_[tile].rows[k] & block_columns(column);
    }
  }

  // By position in `tiles`; larger comes first, below kRanks.
  std::size_t rank(std::size_t tile, int unit) const noexcept { return ranks_[tile].of[unit]; }
  bool any_never_committed() const noexcept { return !never_.empty(); }
  const TileMask& never_committed(std::size_t tile) const noexcept { return never_[tile]; }  // where there are any

  // Differs from call to call.
  std::uint32_t scrambled_position(std::size_t tile, int unit) const noexcept {
    return scrambled((static_cast<std::uint32_t>(tiles_[tile].tile) << 11 | static_cast<std::uint32_t>(unit)) ^ round_);
  }

 private:
  static constexpr int kPixels = kTileWidth * kTileHeight, kBlocksAcross = kTileWidth / kBlockWidth;
  static constexpr int kUnits = kPixels + kBlocksAcross * (kTileHeight / kBlockHeight);
  struct Ranks {
    std::uint16_t of[kUnits];
  };

  static int block(int row, int column) noexcept {
    return kPixels + row / kBlockHeight * kBlocksAcross + column / kBlockWidth;
  }
  static std::uint64_t block_columns(int column) noexcept {
    return first_pixels(kBlockWidth) << column / kBlockWidth * kBlockWidth;
  }
  void rank_tile(std::size_t tile, const TileGrid& grid, const Priorities& priorities);

  const std::vector<TileWork>& tiles_;
  const std::uint32_t round_;
  const bool buckets_;
  std::vector<Ranks> ranks_;
  std::vector<TileMask> by_block_, never_;
};

}  // namespace pullfocus
