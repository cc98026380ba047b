// Taking frames over into the committed state.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <span>

#include "importance/change.h"
#include "importance/tile_row.h"

namespace pullfocus {

namespace {

constexpr int kMany = kTileWidth / 4;  // pixels of a tile row to look at the whole of it for

}  // namespace

Committed commit_all(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, const Sanitiser& sanitiser,
                     SourceState& state, std::vector<TileWork>& tiles) {
  state.may_hold_out = frame.has_mask();
  const TileGrid grid = grid_of(frame.window());
  tiles.resize(static_cast<std::size_t>(grid.count()));
  std::vector<TileRow> rows(static_cast<std::size_t>(grid.rows()));
  dispatch(frame.colour.type(), [&]<SampleType type>() {
    const SegmentIngest<type> ingest(frame, coc, kernels.coc(), sanitiser);
    const auto segment = [&](int x, int y, int n, TileRow& row) {
      std::int16_t* index = &state.index[position(grid, x, y)];
      Pixel<type>* pixels = pixels_of<type>(state.colour, x, y);
      ingest.indices(x, y, n, index, row.findings);
      ingest.sanitised(x, y, n, pixels, row.findings);
      row.opaque = row.opaque && are_opaque<type>(pixels, n);
      row.edges.committed += edges_of(kernels, index, n);
      return largest_reach(index, n);
    };
    tbb::parallel_for(0, grid.rows(), [&](int r) {
      TileRow& row = rows[static_cast<std::size_t>(r)];
      const int first = r * grid.columns();
      const auto of_row =
          std::span(tiles).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(grid.columns()));
      for (int c = 0; c < grid.columns(); ++c) of_row[static_cast<std::size_t>(c)] = {first + c, 0, {}};
      // By rows of pixels, not by tiles: memory is read in one stream.
      for (int i = 0; i < grid.tile_height(first); ++i) {
        for (TileWork& work : of_row) {
          const int n = grid.tile_width(work.tile);
          work.mask.rows[i] = first_pixels(n);
          work.max_index = std::max(work.max_index, segment(grid.x(work.tile), grid.y(work.tile) + i, n, row));
        }
      }
    });
  });
  Committed all;
  for (const TileRow& row : rows) {
    all.findings.add(row.findings);
    all.opaque &= row.opaque;
    all.edges += row.edges.committed;
  }
  return all;
}

void commit(const Frame& frame, const Sanitiser& sanitiser, const std::vector<std::int16_t>& pending,
            const std::vector<TileWork>& tiles, SourceState& state) {
  state.may_hold_out |= frame.has_mask();
  const TileGrid grid = grid_of(state.colour.window());
  dispatch(frame.colour.type(), [&]<SampleType type>() {
    const auto commit_row = [&](int x, int y, int n, std::uint64_t mask) {
      const Pixel<type>* in = pixels_of<type>(frame.colour, x, y);
      Pixel<type>* out = pixels_of<type>(state.colour, x, y);
      const std::int16_t* from = &pending[position(grid, x, y)];
      std::int16_t* to = &state.index[position(grid, x, y)];
      if (mask == first_pixels(n) && all_sane<type>(sanitiser, in, n)) {
        std::copy_n(in, n, out);
        std::copy_n(from, n, to);
        return;
      }
      const bool sane = std::popcount(mask) > kMany && all_sane<type>(sanitiser, in, n);
      for_each_pixel(mask, [&](int p) {
        out[p] = sane ? in[p] : sanitiser(in[p]);
        to[p] = from[p];
      });
    };
    const auto commit_tile = [&](const TileWork& work) {
      const int x = grid.x(work.tile), y = grid.y(work.tile), n = grid.tile_width(work.tile);
      for (int i = 0; i < kTileHeight; ++i) {
        if (work.mask.rows[i] != 0) commit_row(x, y + i, n, work.mask.rows[i]);
      }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) commit_tile(tiles[t]);
    });
  });
}

}  // namespace pullfocus
