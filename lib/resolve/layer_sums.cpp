#include "resolve/layer_sums.h"

#include <algorithm>

#include "scatter/sums.h"

namespace pullfocus {

namespace {

// From this size of one layer on its sums would be gone from the caches before anyone reads them again.
constexpr std::size_t kBeyondCaches = std::size_t{1} << 25;  // bytes

}  // namespace

LayerSums::Tile LayerSums::new_tile() const { return Tile(CacheAligned<Accumulator>().allocate(tile_words())); }

void LayerSums::clear(const Tile& tile) const noexcept { std::fill_n(tile.get(), tile_words(), Accumulator{0}); }

void LayerSums::reset(int width, int height, int layers, int lanes) {
  grid_ = {width, height};
  layers_ = layers;
  lanes_ = lanes;
  tiles_.clear();
  tiles_.resize(static_cast<std::size_t>(layers) * static_cast<std::size_t>(grid_.count()));
  spare_.clear();
}

void LayerSums::make_room(int layer, const Window& reached) {
  const Window part = intersect(reached, {0, 0, grid_.width, grid_.height});
  if (part.empty()) return;
  for (int y = part.y0 / kTileHeight * kTileHeight; y < part.y1; y += kTileHeight) {
    for (int x = part.x0 / kTileWidth * kTileWidth; x < part.x1; x += kTileWidth) {
      Tile& tile = tiles_[index(layer, x, y)];
      if (tile) continue;
      if (spare_.empty()) {
        tile = new_tile();
      } else {
        tile = std::move(spare_.back());
        spare_.pop_back();
      }
      // Rows that are replaced touch new memory first: several threads do, and once.
      if (!anew_) clear(tile);
    }
  }
}

void LayerSums::add(int layer, int y, const ColumnSpan& span, const Accumulator* values) noexcept {
  for (int x = span.x0; x < span.x1;) {
    const int end = std::min((x / kTileWidth + 1) * kTileWidth, span.x1);
    const std::size_t n = static_cast<std::size_t>(end - x) * static_cast<std::size_t>(lanes_);
    const Tile& tile = tile_at(layer, x, y);
    if (tile) add_sums(values, n, tile.get() + offset(x, y));
    values += n;
    x = end;
  }
}

void LayerSums::begin_anew() {
  for (Tile& tile : tiles_) {
    if (tile) spare_.push_back(std::move(tile));
  }
  anew_ = true;
  is_row_new_.assign(static_cast<std::size_t>(grid_.height), 0);
}

// Rows are zero outside their spans, so they can be copied whole.
void LayerSums::replace_row(int y, std::span<const LayerRow> rows) noexcept {
  is_row_new_[static_cast<std::size_t>(y)] = 1;
  const std::size_t layer_bytes = static_cast<std::size_t>(grid_.count()) * tile_words() * sizeof(Accumulator);
  const bool past_caches = layer_bytes >= kBeyondCaches;
  const auto copy = past_caches ? copy_sums_past_caches : copy_sums;
  for (int layer = 0; layer < layers_; ++layer) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const LayerRow& r) { return r.layer == layer; });
    for (int x = 0; x < grid_.width; x += kTileWidth) {
      const Tile& tile = tile_at(layer, x, y);
      if (!tile) continue;
      const auto n = static_cast<std::size_t>(std::min(kTileWidth, grid_.width - x)) * static_cast<std::size_t>(lanes_);
      Accumulator* const out = tile.get() + offset(x, y);
      if (row == rows.end()) {
        std::fill_n(out, n, Accumulator{0});
      } else {
        copy(row->values + static_cast<std::ptrdiff_t>(x) * lanes_, n, out);
      }
    }
  }
  if (past_caches) finish_copies();
}

void LayerSums::end_anew() {
  for (int y = 0; y < grid_.height; ++y) {
    if (is_row_new_[static_cast<std::size_t>(y)] == 0) replace_row(y, {});
  }
  anew_ = false;
}

void LayerSums::widen() {
  std::vector<Tile> narrow = std::move(tiles_);
  const std::size_t pixels = static_cast<std::size_t>(kTileWidth * kTileHeight);
  lanes_ = kAlphaLanes;
  tiles_.clear();
  tiles_.resize(narrow.size());
  spare_.clear();
  for (std::size_t t = 0; t < narrow.size(); ++t) {
    if (!narrow[t]) continue;
    tiles_[t] = new_tile();
    for (std::size_t p = 0; p < pixels; ++p) {
      const Accumulator* in = &narrow[t][p * kOpaqueLanes];
      Accumulator* out = &tiles_[t][p * kAlphaLanes];
      std::copy_n(in, kOpaqueLanes, out);
      out[kAlphaLane] = in[kWeightLane];
    }
    narrow[t].reset();
  }
}

std::vector<Accumulator> LayerSums::plane(int layer) const {
  const auto lanes = static_cast<std::size_t>(lanes_);
  std::vector<Accumulator> plane(static_cast<std::size_t>(grid_.width) * static_cast<std::size_t>(grid_.height) *
                                 lanes);
  for (int y = 0; y < grid_.height; ++y) {
    for (int x = 0; x < grid_.width; x += kTileWidth) {
      const Accumulator* in = at(layer, x, y);
      if (in == nullptr) continue;
      const int n = std::min(kTileWidth, grid_.width - x);
      std::copy_n(in, static_cast<std::size_t>(n) * lanes,
                  &plane[(static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width) + x) * lanes]);
    }
  }
  return plane;
}

std::size_t LayerSums::bytes() const noexcept {
  std::size_t held = spare_.size();
  for (const Tile& tile : tiles_) held += tile != nullptr;
  return held * tile_words() * sizeof(Accumulator) + tiles_.size() * sizeof(Tile);
}

std::int64_t LayerSums::tiles(int layer) const noexcept {
  const auto first = tiles_.begin() + static_cast<std::ptrdiff_t>(layer) * grid_.count();
  return std::count_if(first, first + grid_.count(), [](const Tile& tile) { return tile != nullptr; });
}

}  // namespace pullfocus
