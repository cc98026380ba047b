#include "scatter/layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "image/error.h"

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

// One tile's part in every layer.
void split(const TileWork& work, const TileGrid& grid, const Layers& layers, const SourceState& state,
           const std::int16_t* pending, TileWork* parts) {
  for (int l = 0; l < layers.count(); ++l) parts[l] = {work.tile, 0, {}};
  for (int i = 0; i < kTileHeight; ++i) {
    if (work.mask.rows[i] == 0) continue;
    const std::size_t row = static_cast<std::size_t>(grid.y(work.tile) + i) * static_cast<std::size_t>(grid.width) +
                            static_cast<std::size_t>(grid.x(work.tile));
    if (work.mask.rows[i] == first_pixels(kTileWidth)) {  // mostly of one layer
      IndexBounds bounds = bounds_of_tile_row(&state.index[row]);
      if (pending != nullptr) bounds.widen(bounds_of_tile_row(&pending[row]));
      if (layers.share_one(bounds.least, bounds.most)) {
        TileWork& part = parts[layers.of(bounds.most)];
        part.mask.rows[i] = work.mask.rows[i];
        part.max_index = std::max(part.max_index, bounds.largest());
        continue;
      }
    }
    for_each_pixel(work.mask.rows[i], [&](int p) {
      const auto add = [&](std::int16_t index) {
        if (!is_source(index)) return;
        TileWork& part = parts[layers.of(index)];
        part.mask.rows[i] |= std::uint64_t{1} << p;
        part.max_index = std::max(part.max_index, reach_index(index));
      };
      const std::size_t at = row + static_cast<std::size_t>(p);
      add(state.index[at]);
      if (pending != nullptr) add(pending[at]);
    });
  }
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
