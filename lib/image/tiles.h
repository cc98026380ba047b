// The grid of tiles that change detection, selection and scatter share: 64 x 16 pixels, one machine word a
// row.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace pullfocus {

inline constexpr int kTileWidth = 64;
inline constexpr int kTileHeight = 16;

// Tiles over an image of width x height pixels, counted from its top left corner, rows of tiles top down.
struct TileGrid {
  int width = 0, height = 0;

  int columns() const noexcept { return (width + kTileWidth - 1) / kTileWidth; }
  int rows() const noexcept { return (height + kTileHeight - 1) / kTileHeight; }
  int count() const noexcept { return columns() * rows(); }
  int x(int tile) const noexcept { return tile % columns() * kTileWidth; }
  int y(int tile) const noexcept { return tile / columns() * kTileHeight; }
  int tile_width(int tile) const noexcept {
    const int rest = width - x(tile);
    return rest < kTileWidth ? rest : kTileWidth;
  }
  int tile_height(int tile) const noexcept {
    const int rest = height - y(tile);
    return rest < kTileHeight ? rest : kTileHeight;
  }
};

// A set of pixels of one tile: bit x of rows[y], from the tile's top left corner.
struct TileMask {
  std::uint64_t rows[kTileHeight] = {};

  bool any() const noexcept {
    std::uint64_t all = 0;
    for (const std::uint64_t row : rows) all |= row;
    return all != 0;
  }
  // Bounds of the set: columns [x0, x1), rows [y0, y1) from the tile's corner. Not for an empty set.
  struct Bounds {
    int x0, y0, x1, y1;
  };
  Bounds bounds() const noexcept {
    std::uint64_t all = 0;
    int first = kTileHeight, last = 0;
    for (int y = 0; y < kTileHeight; ++y) {
      if (rows[y] == 0) continue;
      all |= rows[y];
      if (y < first) first = y;
      last = y;
    }
    return {std::countr_zero(all), first, 64 - std::countl_zero(all), last + 1};
  }
  int count() const noexcept {
    int n = 0;
    for (const std::uint64_t row : rows) n += ~row == 0 ? 64 : std::popcount(row);  // the latter may be a call
    return n;
  }
};

// Mask of the first n pixels of a tile row, 0 <= n <= 64.
inline std::uint64_t first_pixels(int n) noexcept { return n >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1; }

// Calls visit(x) for every set bit, ascending.
template <typename Visit>
void for_each_pixel(std::uint64_t row, Visit&& visit) {
  for (; row != 0; row &= row - 1) visit(std::countr_zero(row));
}

}  // namespace pullfocus
