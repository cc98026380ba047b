// Finding what differs from the committed state, row of tiles by row of tiles.
#pragma once

#include <algorithm>

#include "importance/distance.h"
#include "importance/importance.h"
#include "importance/tile_row.h"
#include "scatter/occlusion.h"

namespace pullfocus {

// One row of a tile, from (x, y) of the window's corner on, n pixels of it in the picture.
template <SampleType type>
struct ChangedRow {
  int x, y, n;
  std::uint64_t changed;      // its changed pixels
  const Pixel<type>* pixels;  // of the frame, sanitised
  const std::int16_t* index;  // of the frame
  const std::int16_t* was;    // committed
  int max_index;              // of the tile's rows so far
};

// The larger one of `least` and the largest |index| of the changed pixels, of which `index` holds the row.
template <SampleType type>
int reach_of(const ChangedRow<type>& row, const std::int16_t* index, int least) noexcept {
  if (row.n == kTileWidth) {
    const IndexBounds bounds = bounds_of_tile_row(index);
    if (is_source(static_cast<std::int16_t>(bounds.least))) {
      if (bounds.largest() <= least) return least;
      if (row.changed == first_pixels(kTileWidth)) return bounds.largest();
    }
  }
  for_each_pixel(row.changed, [&](int i) { least = std::max(least, reach_index(index[i])); });
  return least;
}

template <SampleType type>
class Detector {
 public:
  // All references must outlive this.
  Detector(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser,
           const SourceState& state, const ChangeThresholds& thresholds, const Occlusion* occlusion,
           RememberedDepths* remembered)
      : ingest_(frame, coc, table, sanitiser),
        table_(table),
        state_(state),
        thresholds_(thresholds),
        frame_(frame),
        has_mask_(frame.has_mask()),
        kind_(coc.kind),
        occlusion_(occlusion),
        remembered_(remembered),
        grid_(grid_of(state.colour.window())) {}

  // Tiles `first` .. `first + grid.columns() - 1`, which are one row of tiles. Goes by rows of pixels, not by tiles:
  // memory is read in one stream. Calls take(ChangedRow, row) for every row of a tile with changed pixels, which
  // returns the tile's max_index with that row in it.
  template <typename Take>
  void run(int first, TileRow& row, const Take& take) const {
    for (int i = 0; i < grid_.tile_height(first); ++i) {
      const int y = grid_.y(first) + i;
      bool quiet = true;  // nothing changed just before
      for (int c = 0; c < grid_.columns(); ++c) {
        if (quiet) c += unchanged(c, y, row.findings);
        if (c == grid_.columns()) break;
        const int tile = first + c;
        const auto at = static_cast<std::size_t>(c);
        int max_index = row.tiles.empty() ? 0 : row.tiles[at].max_index;
        const std::uint64_t mask = segment(grid_.x(tile), y, grid_.tile_width(tile), max_index, row, take);
        quiet = mask == 0;
        if (quiet) continue;
        if (row.tiles.empty()) row.tiles = all_tiles(first);
        row.tiles[at].max_index = max_index;
        row.tiles[at].mask.rows[i] = mask;
      }
    }
    std::erase_if(row.tiles, [](const TileWork& work) { return !work.mask.any(); });
    for (const TileWork& work : row.tiles) row.pixels += work.mask.count();
  }

 private:
  // Of the row of tiles: only where something changed, as most rows of most frames need none.
  std::vector<TileWork> all_tiles(int first) const {
    std::vector<TileWork> tiles(static_cast<std::size_t>(grid_.columns()));
    for (int c = 0; c < grid_.columns(); ++c) tiles[static_cast<std::size_t>(c)].tile = first + c;
    return tiles;
  }

  // How many whole tiles from column c on have nothing changed in row y that could be seen at a glance.
  int unchanged(int c, int y, FrameFindings& findings) const noexcept {
    if (remembered_ == nullptr || occlusion_ != nullptr) return 0;
    const int x = c * kTileWidth;
    const Pixel<type>* const old = pixels_of<type>(state_.colour, x, y);
    return ingest_.unchanged(x, y, grid_.width / kTileWidth - c, old, &state_.index[position(grid_, x, y)],
                             *remembered_, findings);
  }

  template <typename Take>
  std::uint64_t segment(int x, int y, int n, int& max_index, TileRow& row, const Take& take) const {
    std::int16_t index[kTileWidth];
    const std::int16_t* committed = &state_.index[position(grid_, x, y)];
    const Pixel<type>* old = pixels_of<type>(state_.colour, x, y);
    const SegmentDifference difference = ingest_.compare(x, y, n, old, committed, remembered_, index, row.findings);
    // What was committed is sane, so equal bits are equal sane colours.
    const std::uint64_t key = occlusion_ == nullptr ? 0 : changed_keys(index, x, y, n);
    if ((difference.index | difference.colour | key) == 0) return 0;
    if (difference.known) std::copy_n(committed, n, index);
    return changed_pixels(x, y, n, difference, key, index, max_index, row, take);
  }

  // Apart, so that segments without any change, most of all, do not pay for it.
  template <typename Take>
  [[gnu::noinline]] std::uint64_t changed_pixels(int x, int y, int n, const SegmentDifference& difference,
                                                 std::uint64_t key, const std::int16_t* index, int& max_index,
                                                 TileRow& row, const Take& take) const {
    const std::int16_t* committed = &state_.index[position(grid_, x, y)];
    const Pixel<type>* old = pixels_of<type>(state_.colour, x, y);
    Pixel<type> pixels[kTileWidth];
    const bool sane = ingest_.sanitised(x, y, n, pixels, row.findings);
    std::uint64_t changed = difference.index | key;
    if (sane) {
      changed |= difference.colour;
    } else {
      for_each_pixel(difference.colour, [&](int i) { changed |= std::uint64_t{!(pixels[i] == old[i])} << i; });
    }
    if (thresholds_.any()) changed = beyond_thresholds(changed, key, pixels, old, index, committed);
    if (changed == 0) return 0;
    if (row.opaque && !are_opaque<type>(pixels, n)) {
      for_each_pixel(changed, [&](int i) { row.opaque &= is_opaque<type>(pixels[i]); });
    }
    max_index = take(ChangedRow<type>{x, y, n, changed, pixels, index, committed, max_index}, row);
    return changed;
  }

  std::uint64_t changed_keys(const std::int16_t* index, int x, int y, int n) const noexcept {
    return occlusion_->changed_keys(kind_, frame_.depth.row(frame_.window().y0 + y) + x, has_mask_ ? index : nullptr, x,
                                    y, n);
  }

  std::uint64_t beyond_thresholds(std::uint64_t changed, std::uint64_t key, const Pixel<type>* is,
                                  const Pixel<type>* was, const std::int16_t* index,
                                  const std::int16_t* committed) const {
    std::uint64_t beyond = 0;
    for_each_pixel(changed, [&](int i) {
      const bool small = (colour_distance<type>(is[i], was[i]) <= thresholds_.rgb &&
                          alpha_distance<type>(is[i], was[i]) <= thresholds_.rgb) ||
                         channel_distance<type>(is[i], was[i]) <= thresholds_.channel;
      const bool same_depth = (key >> i & 1) == 0 || thresholds_.coc_px > 0;
      const bool near_enough =
          index[i] == committed[i] || (is_source(index[i]) && is_source(committed[i]) &&
                                       coc_distance(table_, index[i], committed[i]) <= thresholds_.coc_px);
      const bool exempt = small && same_depth && near_enough;
      beyond |= std::uint64_t{!exempt} << i;
    });
    return beyond;
  }

  const SegmentIngest<type> ingest_;
  const CocTable& table_;
  const SourceState& state_;
  const ChangeThresholds& thresholds_;
  const Frame& frame_;
  const bool has_mask_;
  const DepthKind kind_;
  const Occlusion* occlusion_;
  RememberedDepths* const remembered_;
  const TileGrid grid_;
};

}  // namespace pullfocus
