#include "importance/change.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "importance/distance.h"

namespace pullfocus {

namespace {

template <SampleType type>
bool is_opaque(const Pixel<type>& pixel) noexcept {
  return pixel.rgba[3] == (type == SampleType::half ? 0x3c00u : 0x3f800000u);
}

template <SampleType type>
bool are_opaque(const Pixel<type>* pixels, int n) noexcept {
  bool all = true;
  for (int i = 0; i < n; ++i) all &= is_opaque<type>(pixels[i]);
  return all;
}

std::size_t at(const TileGrid& grid, int x, int y) noexcept {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
}

TileGrid grid_of(const Window& window) noexcept { return {window.width(), window.height()}; }

template <SampleType type>
Pixel<type>* pixels_of(ColourImage& image, int x, int y) noexcept {
  return reinterpret_cast<Pixel<type>*>(image.pixel(image.window().x0 + x, image.window().y0 + y));
}

template <SampleType type>
const Pixel<type>* pixels_of(const ColourImage& image, int x, int y) noexcept {
  return pixels_of<type>(const_cast<ColourImage&>(image), x, y);
}

// One row of tiles: what its task found.
struct TileRow {
  std::vector<TileWork> tiles;
  std::int64_t pixels = 0;
  bool opaque = true;
  FrameFindings findings;
};

template <SampleType type>
class Detector {
 public:
  Detector(const SegmentIngest<type>& ingest, const CocTable& table, const SourceState& state,
           const ChangeThresholds& thresholds, std::vector<std::int16_t>& pending, const Frame& frame, DepthKind kind,
           const Occlusion* occlusion)
      : ingest_(ingest),
        table_(table),
        state_(state),
        thresholds_(thresholds),
        pending_(pending),
        frame_(frame),
        has_mask_(frame.has_mask()),
        kind_(kind),
        occlusion_(occlusion),
        grid_(grid_of(state.colour.window())) {}

  // Tiles `first` .. `first + grid.columns() - 1`, which are one row of tiles. Goes by rows of pixels, not by tiles:
  // memory is read in one stream.
  void run(int first, TileRow& row) const {
    row.tiles.resize(static_cast<std::size_t>(grid_.columns()));
    for (int c = 0; c < grid_.columns(); ++c) row.tiles[static_cast<std::size_t>(c)].tile = first + c;
    for (int i = 0; i < grid_.tile_height(first); ++i) {
      for (TileWork& work : row.tiles) {
        work.mask.rows[i] =
            segment(grid_.x(work.tile), grid_.y(work.tile) + i, grid_.tile_width(work.tile), work.max_index, row);
      }
    }
    std::erase_if(row.tiles, [](const TileWork& work) { return !work.mask.any(); });
    for (const TileWork& work : row.tiles) row.pixels += work.mask.count();
  }

 private:
  std::uint64_t segment(int x, int y, int n, int& max_index, TileRow& row) const {
    std::int16_t index[kTileWidth];
    const std::int16_t* committed = &state_.index[at(grid_, x, y)];
    const Pixel<type>* old = pixels_of<type>(state_.colour, x, y);
    const SegmentDifference difference = ingest_.compare(x, y, n, old, committed, index, row.findings);
    // What was committed is sane, so equal bits are equal sane colours.
    const std::uint64_t key = occlusion_ == nullptr ? 0 : changed_keys(index, x, y, n);
    if ((difference.index | difference.colour | key) == 0) return 0;
    return changed_pixels(x, y, n, difference, key, index, max_index, row);
  }

  // Apart, so that segments without any change, most of all, do not pay for it.
  [[gnu::noinline]] std::uint64_t changed_pixels(int x, int y, int n, const SegmentDifference& difference,
                                                 std::uint64_t key, const std::int16_t* index, int& max_index,
                                                 TileRow& row) const {
    const std::int16_t* committed = &state_.index[at(grid_, x, y)];
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
    std::copy(index, index + n, &pending_[at(grid_, x, y)]);
    max_index = std::max(max_index, reach_of(changed, committed, index));
    return changed;
  }

  // The largest |index| of the changed pixels, before and after.
  static int reach_of(std::uint64_t changed, const std::int16_t* before, const std::int16_t* after) noexcept {
    if (changed == first_pixels(kTileWidth)) {
      IndexBounds bounds = bounds_of_tile_row(before);
      bounds.widen(bounds_of_tile_row(after));
      if (is_source(static_cast<std::int16_t>(bounds.least))) return bounds.largest();
    }
    int reach = 0;
    for_each_pixel(changed, [&](int i) { reach = std::max({reach, reach_index(before[i]), reach_index(after[i])}); });
    return reach;
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

  const SegmentIngest<type>& ingest_;
  const CocTable& table_;
  const SourceState& state_;
  const ChangeThresholds& thresholds_;
  std::vector<std::int16_t>& pending_;
  const Frame& frame_;
  const bool has_mask_;
  const DepthKind kind_;
  const Occlusion* occlusion_;
  const TileGrid grid_;
};

}  // namespace

Changes find_changes(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser,
                     const SourceState& state, const ChangeThresholds& thresholds, std::vector<std::int16_t>& pending,
                     const Occlusion* occlusion) {
  const TileGrid grid = grid_of(state.colour.window());
  std::vector<TileRow> rows(static_cast<std::size_t>(grid.rows()));
  dispatch(frame.colour.type(), [&]<SampleType type>() {
    const SegmentIngest<type> ingest(frame, coc, table, sanitiser);
    const Detector<type> detector(ingest, table, state, thresholds, pending, frame, coc.kind, occlusion);
    tbb::parallel_for(0, grid.rows(),
                      [&](int r) { detector.run(r * grid.columns(), rows[static_cast<std::size_t>(r)]); });
  });
  Changes changes;
  for (const TileRow& row : rows) {
    changes.tiles.insert(changes.tiles.end(), row.tiles.begin(), row.tiles.end());
    changes.pixels += row.pixels;
    changes.opaque &= row.opaque;
    changes.findings.add(row.findings);
  }
  return changes;
}

FrameFindings commit_all(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser,
                         SourceState& state, std::vector<TileWork>& tiles, bool& opaque) {
  state.may_hold_out = frame.has_mask();
  const TileGrid grid = grid_of(frame.window());
  tiles.resize(static_cast<std::size_t>(grid.count()));
  std::vector<TileRow> rows(static_cast<std::size_t>(grid.rows()));
  dispatch(frame.colour.type(), [&]<SampleType type>() {
    const SegmentIngest<type> ingest(frame, coc, table, sanitiser);
    const auto segment = [&](int x, int y, int n, TileRow& row) {
      std::int16_t* index = &state.index[at(grid, x, y)];
      Pixel<type>* pixels = pixels_of<type>(state.colour, x, y);
      ingest.indices(x, y, n, index, row.findings);
      ingest.sanitised(x, y, n, pixels, row.findings);
      row.opaque = row.opaque && are_opaque<type>(pixels, n);
      int largest = 0;
      for (int i = 0; i < n; ++i) largest = std::max(largest, reach_index(index[i]));
      return largest;
    };
    tbb::parallel_for(0, grid.rows(), [&](int r) {
      TileRow& row = rows[static_cast<std::size_t>(r)];
      for (int c = 0; c < grid.columns(); ++c) {
        const int tile = r * grid.columns() + c;
        TileWork& work = tiles[static_cast<std::size_t>(tile)];
        work = {tile, 0, {}};
        for (int i = 0; i < grid.tile_height(tile); ++i) {
          work.mask.rows[i] = first_pixels(grid.tile_width(tile));
          work.max_index =
              std::max(work.max_index, segment(grid.x(tile), grid.y(tile) + i, grid.tile_width(tile), row));
        }
      }
    });
  });
  FrameFindings findings;
  opaque = true;
  for (const TileRow& row : rows) {
    findings.add(row.findings);
    opaque &= row.opaque;
  }
  return findings;
}

void commit(const Frame& frame, const Sanitiser& sanitiser, const std::vector<std::int16_t>& pending,
            const std::vector<TileWork>& tiles, SourceState& state) {
  state.may_hold_out |= frame.has_mask();
  const TileGrid grid = grid_of(state.colour.window());
  dispatch(frame.colour.type(), [&]<SampleType type>() {
    const auto commit_tile = [&](const TileWork& work) {
      for (int i = 0; i < kTileHeight; ++i) {
        if (work.mask.rows[i] == 0) continue;
        const int x = grid.x(work.tile), y = grid.y(work.tile) + i;
        const Pixel<type>* in = pixels_of<type>(frame.colour, x, y);
        Pixel<type>* out = pixels_of<type>(state.colour, x, y);
        if (work.mask.rows[i] == first_pixels(kTileWidth) && all_sane<type>(sanitiser, in, kTileWidth)) {
          std::copy_n(in, kTileWidth, out);
          std::copy_n(&pending[at(grid, x, y)], kTileWidth, &state.index[at(grid, x, y)]);
          continue;
        }
        for_each_pixel(work.mask.rows[i], [&](int p) {
          out[p] = sanitiser(in[p]);
          state.index[at(grid, x + p, y)] = pending[at(grid, x + p, y)];
        });
      }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) commit_tile(tiles[t]);
    });
  });
}

}  // namespace pullfocus
