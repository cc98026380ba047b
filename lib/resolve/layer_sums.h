// The accumulators of all layers, in tiles: memory only where a layer has reached.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "image/tiles.h"
#include "image/window.h"
#include "scatter/scatter.h"
#include "simd/aligned.h"

namespace pullfocus {

class LayerSums {
 public:
  // All sums zero, no memory held. Size of the state window in pixels.
  void reset(int width, int height, int layers, int lanes);

  int layers() const noexcept { return layers_; }
  int lanes() const noexcept { return lanes_; }

  // Makes room in a layer for the pixels of `reached` (columns and rows from the window's corner; what lies outside is
  // ignored), all zero where there was none. Not to be called while other threads add.
  void make_room(int layer, const Window& reached);

  // Gives all sums new values, with less traffic than clearing and adding: after begin_anew(), make room for all that
  // the layers reach, hand over every row that is not zero with replace_row() (different rows from different threads),
  // and end_anew().
  void begin_anew();
  void replace_row(int y, std::span<const LayerRow> rows) noexcept;
  void end_anew();

  // Adds a span of a row. Spans are whole cells of a band, so they may begin and end with zeros for which no room was
  // made: these are left out. Different rows may be added to by different threads.
  void add(int layer, int y, const ColumnSpan& span, const Accumulator* values) noexcept;

  // `lanes()` accumulators a pixel from column x of row y on, up to the end of its tile; null where the layer has never
  // reached.
  const Accumulator* at(int layer, int x, int y) const noexcept {
    const Tile& tile = tile_at(layer, x, y);
    return tile ? tile.get() + offset(x, y) : nullptr;
  }

  // From kOpaqueLanes to kAlphaLanes, with the alpha of sources that are all opaque.
  void widen();

  // One layer row by row, `lanes()` accumulators a pixel: for tests and tools.
  std::vector<Accumulator> plane(int layer) const;
  std::size_t bytes() const noexcept;
  std::int64_t tiles(int layer) const noexcept;  // that hold memory

 private:
  // On cache lines, as vectors are written past the caches.
  struct Delete {
    void operator()(Accumulator* values) const noexcept { CacheAligned<Accumulator>().deallocate(values, 0); }
  };
  using Tile = std::unique_ptr<Accumulator[], Delete>;
  Tile new_tile() const;  // of any content
  void clear(const Tile& tile) const noexcept;
  std::size_t tile_words() const noexcept {
    return static_cast<std::size_t>(kTileWidth * kTileHeight) * static_cast<std::size_t>(lanes_);
  }
  std::size_t offset(int x, int y) const noexcept {
    return static_cast<std::size_t>(y % kTileHeight * kTileWidth + x % kTileWidth) * static_cast<std::size_t>(lanes_);
  }
  std::size_t index(int layer, int x, int y) const noexcept {
    return static_cast<std::size_t>(layer) * static_cast<std::size_t>(grid_.count()) +
           static_cast<std::size_t>(y / kTileHeight * grid_.columns() + x / kTileWidth);
  }
  const Tile& tile_at(int layer, int x, int y) const noexcept { return tiles_[index(layer, x, y)]; }

  TileGrid grid_;
  int layers_ = 0, lanes_ = kOpaqueLanes;
  std::vector<Tile> tiles_;  // layer after layer
  std::vector<Tile> spare_;  // of any content
  bool anew_ = false;        // between begin_anew() and end_anew()
  std::vector<std::uint8_t> is_row_new_;
};

}  // namespace pullfocus
