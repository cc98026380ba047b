// How the incremental filter turns sums into its result, and what it shows where nothing is committed yet.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "filter/incremental_filter.h"
#include "resolve/held_out.h"
#include "resolve/resolve.h"

namespace pullfocus {

// Before they are committed. They showed the input, so they must be resolved even where their kernels do not reach
// them.
void IncrementalFilter::no_longer_uncommitted(const std::vector<TileWork>& tiles) {
  if (uncommitted_ == 0) return;
  const TileGrid grid = grid_of(core_.window);
  for (const TileWork& work : tiles) {
    for_each_tile_pixel(grid, work, [&](int, int, int x, int y) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
      if (state_.index[at] != kNeverCommitted) return;
      --uncommitted_;
      dirty_.mark(y, x, x + 1);
    });
  }
}

// A pixel never committed shows the frame itself, sanitised.
void IncrementalFilter::show_uncommitted() {
  const Window& w = core_.window;
  const auto show_row = [&]<SampleType type, SampleType out_type>(int y) {
    const std::int16_t* index = &state_.index[static_cast<std::size_t>(y - w.y0) * static_cast<std::size_t>(w.width())];
    const auto* in = reinterpret_cast<const Pixel<type>*>(frame_->colour.pixel(w.x0, y));
    auto* out = reinterpret_cast<Pixel<out_type>*>(result_.pixel(w.x0, y));
    for (int i = 0; i < w.width(); ++i) {
      if (index[i] != kNeverCommitted) continue;
      const Pixel<type> pixel = core_.sanitiser(in[i]);
      if constexpr (type == out_type) {
        out[i] = pixel;
        continue;
      }
      for (int c = 0; c < 4; ++c) {
        const float value = sample_value(pixel.rgba[c]);
        if constexpr (out_type == SampleType::float32) {
          std::memcpy(&out[i].rgba[c], &value, sizeof value);
        } else {
          result_.set(w.x0 + i, y, c, std::clamp(value, -65504.f, 65504.f));
        }
      }
    }
  };
  dispatch(frame_->colour.type(), [&]<SampleType type>() {
    dispatch(result_.type(), [&]<SampleType out_type>() {
      tbb::parallel_for(w.y0, w.y1, [&](int y) { show_row.template operator()<type, out_type>(y); });
    });
  });
}

void IncrementalFilter::resolve_dirty() {
  if (dirty_.pixels() > 0) {
    if (!sums_kept_) scatter_state(true, false);  // the result has another type
    resolve_rows_of_sums();
  }
  if (core_.backdrop) core_.backdrop->fill(result_);
  show_held_out(state_, result_);
}

void IncrementalFilter::resolve_rows_of_sums() {
  std::vector<std::int64_t> resolved(static_cast<std::size_t>(core_.window.height()));
  tbb::parallel_for(0, core_.window.height(),
                    [&](int y) { resolved[static_cast<std::size_t>(y)] = resolve_dirty_row(y, true); });
  stats_.resolved += std::accumulate(resolved.begin(), resolved.end(), std::int64_t{0});
}

std::int64_t IncrementalFilter::resolve_dirty_row(int y, bool is_committed) {
  const Accumulator* layers[kMostLayers];
  const auto count = static_cast<std::size_t>(sums_.layers());
  std::int64_t resolved = 0;
  std::vector<ColumnSpan> without_weight;
  dirty_.drain_row(y, [&](int x0, int x1) {
    for (int x = x0; x < x1;) {
      const int end = std::min((x / kTileWidth + 1) * kTileWidth, x1);
      for (std::size_t l = 0; l < count; ++l) layers[l] = sums_.at(static_cast<int>(l), x, y);
      const bool all = resolve_layers({layers, count}, lanes(), x, end, y, state_.colour, result_,
                                      static_cast<std::size_t>(core_.layers.near()), core_.behind());
      if (all || is_committed) {
        resolved += end - x;
      } else {
        without_weight.push_back({x, end});
      }
      x = end;
    }
  });
  for (const ColumnSpan& span : without_weight) dirty_.mark(y, span.x0, span.x1);
  return resolved;
}

}  // namespace pullfocus
