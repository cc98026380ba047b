#include "scatter/layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "image/error.h"
#include "scatter/index_row.h"

namespace pullfocus {

void validate_borders(std::span<const double> borders) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorCode::usage, "--visibility layers: " + what + ": give CoC diameters in pixels such as -2,2");
  };
  if (borders.size() > Layers::kMostBorders) refuse("more than " + std::to_string(Layers::kMostBorders) + " borders");
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (!std::isfinite(borders[i])) refuse("a border is not a number");
    if (i > 0 && !(borders[i] > borders[i - 1])) refuse("the borders do not ascend");
  }
}

Layers::Layers(const CocTable& coc, std::span<const double> borders) : offset_(coc.size() - 1) {
  validate_borders(borders);
  ranges_.assign(borders.size() + 1, Range{1, 0});
  for (int index = -offset_; index <= offset_; ++index) {
    const double c = coc.signed_diameter(index);
    std::size_t layer = 0;
    while (layer < borders.size() && (borders[layer] > 0 ? c > borders[layer] : c >= borders[layer])) ++layer;
    of_.push_back(static_cast<std::uint8_t>(layer));
    Range& range = ranges_[layer];
    if (range.first > range.last) range.first = static_cast<std::int16_t>(index);
    range.last = static_cast<std::int16_t>(index);
  }
}

int Layers::near() const noexcept {
  int near = 0;
  for (const Range& range : ranges_) {
    if (range.first <= range.last && range.last >= 0) break;
    ++near;
  }
  return near;
}

namespace {

// The part of pixels `mask` of row i of a tile, whose indices begin at `index`, in every layer.
void split_row(const std::int16_t* index, std::uint64_t mask, int i, const Layers& layers, TileWork* parts) {
  const IndexBounds bounds = bounds_of_tile_row(index);
  for (int l = 0; l < layers.count(); ++l) {
    const Layers::Range range = layers.range(l);
    if (range.first > bounds.most || range.last < bounds.least) continue;
    const std::uint64_t in_layer = mask & within(index, range.first, range.last);
    if (in_layer == 0) continue;
    parts[l].mask.rows[i] |= in_layer;
    parts[l].max_index = std::max(parts[l].max_index, largest_of(index, in_layer));
  }
}

// One tile's part in every layer.
void split(const TileWork& work, const TileGrid& grid, const Layers& layers, const SourceState& state,
           const std::int16_t* pending, TileWork* parts) {
  for (int l = 0; l < layers.count(); ++l) parts[l] = {work.tile, 0, {}};
  const int n = grid.tile_width(work.tile);
  const auto split_rows = [&](const std::int16_t* indices) {
    std::int16_t padded[kTileWidth] = {};  // where the tile reaches beyond the picture, no pixel is in its mask
    for (int i = 0; i < kTileHeight; ++i) {
      if (work.mask.rows[i] == 0) continue;
      const std::int16_t* index =
          indices + static_cast<std::size_t>(grid.y(work.tile) + i) * static_cast<std::size_t>(grid.width) +
          static_cast<std::size_t>(grid.x(work.tile));
      if (n < kTileWidth) {
        std::copy_n(index, n, padded);
        index = padded;
      }
      split_row(index, work.mask.rows[i], i, layers, parts);
    }
  };
  split_rows(state.index.data());
  if (pending != nullptr) split_rows(pending);
}

}  // namespace

std::vector<LayerWork> by_layer(const std::vector<TileWork>& tiles, const Layers& layers, const SourceState& state,
                                const std::int16_t* pending) {
  std::vector<LayerWork> work;
  const auto count = static_cast<std::size_t>(layers.count());
  for (int l = 0; l < layers.count(); ++l) work.push_back({l, layers.range(l), {}});
  if (count == 1) {
    work[0].tiles = tiles;
  } else {
    const TileGrid grid{state.colour.window().width(), state.colour.window().height()};
    std::vector<TileWork> parts(tiles.size() * count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether / 8), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) {
        split(tiles[t], grid, layers, state, pending, &parts[t * count]);
      }
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].mask.any()) work[i % count].tiles.push_back(parts[i]);
    }
  }
  std::erase_if(work, [](const LayerWork& layer) { return layer.tiles.empty(); });
  return work;
}

}  // namespace pullfocus
