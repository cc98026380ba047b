#include "importance/change.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "importance/detector.h"

namespace pullfocus {

namespace {

// Calls take(detector's row, what its row of tiles found) for all rows of tiles with changed pixels.
template <SampleType type, typename Take>
std::vector<TileRow> detect(const Detector<type>& detector, const TileGrid& grid, const Take& take) {
  std::vector<TileRow> rows(static_cast<std::size_t>(grid.rows()));
  tbb::parallel_for(0, grid.rows(),
                    [&](int r) { detector.run(r * grid.columns(), rows[static_cast<std::size_t>(r)], take); });
  return rows;
}

Changes joined(const std::vector<TileRow>& rows) {
  Changes changes;
  for (const TileRow& row : rows) {
    changes.tiles.insert(changes.tiles.end(), row.tiles.begin(), row.tiles.end());
    changes.pixels += row.pixels;
    changes.opaque &= row.opaque;
    changes.edges.add(row.edges);
    changes.findings.add(row.findings);
  }
  return changes;
}

}  // namespace

Changes find_changes(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser,
                     const SourceState& state, const ChangeThresholds& thresholds, std::vector<std::int16_t>& pending,
                     const Occlusion* occlusion, RememberedDepths* remembered) {
  const TileGrid grid = grid_of(state.colour.window());
  return dispatch(frame.colour.type(), [&]<SampleType type>() {
    const Detector<type> detector(frame, coc, table, sanitiser, state, thresholds, occlusion, remembered);
    return joined(detect(detector, grid, [&](const ChangedRow<type>& found, TileRow&) {
      std::copy_n(found.index, found.n, &pending[position(grid, found.x, found.y)]);
      return reach_of(found, found.index, reach_of(found, found.was, found.max_index));
    }));
  });
}

Changes take_changes(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, const Sanitiser& sanitiser,
                     SourceState& state, const ChangeThresholds& thresholds, const Occlusion* occlusion,
                     RememberedDepths* remembered) {
  const TileGrid grid = grid_of(state.colour.window());
  state.may_hold_out |= frame.has_mask();
  return dispatch(frame.colour.type(), [&]<SampleType type>() {
    const Detector<type> detector(frame, coc, kernels.coc(), sanitiser, state, thresholds, occlusion, remembered);
    return joined(detect(detector, grid, [&](const ChangedRow<type>& found, TileRow& row) {
      std::int16_t* const index = &state.index[position(grid, found.x, found.y)];
      Pixel<type>* const colours = pixels_of<type>(state.colour, found.x, found.y);
      row.edges.add(edges_of_row(kernels, index, found.index, found.changed, found.n));
      // Without thresholds, what did not change is the same in both.
      if (found.changed == first_pixels(found.n) || !thresholds.any()) {
        std::copy_n(found.index, found.n, index);
        std::copy_n(found.pixels, found.n, colours);
      } else {
        for_each_pixel(found.changed, [&](int p) {
          index[p] = found.index[p];
          colours[p] = found.pixels[p];
        });
      }
      return reach_of(found, found.index, found.max_index);
    }));
  });
}

}  // namespace pullfocus
