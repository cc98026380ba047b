// From the masked pixels of one tile row to sources.
#pragma once

#include <algorithm>

#include "image/tiles.h"
#include "scatter/edges.h"
#include "scatter/scatter.h"

namespace pullfocus {

// Emissions of one tile row, ascending in x. A pixel that changes its index emits twice: its new
// contribution, and in the second list the old one taken back.
template <int lanes>
struct EmissionRow {
  int count = 0, removed_count = 0;
  Emission<lanes> emissions[kTileWidth];
  Emission<lanes> removed[kTileWidth];
};

template <int lanes, SampleType type>
void colour_lanes(const Pixel<type>& pixel, double* out) noexcept {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<double>(sample_value(pixel.rgba[c]));
  out[kWeightLane] = 1;
  if constexpr (lanes == kAlphaLanes) out[kAlphaLane] = static_cast<double>(sample_value(pixel.rgba[3]));
}

// Collects the pixels `mask` of the tile row that begins at (x, y), counted from the window's corner.
template <int lanes, SampleType type>
void collect(const Sources& sources, int x, int y, std::uint64_t mask, EmissionRow<lanes>& row) noexcept {
  const Window& window = sources.state->colour.window();
  const auto offset = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width()) + x;
  const auto* old_colours =
      reinterpret_cast<const Pixel<type>*>(sources.state->colour.pixel(window.x0 + x, window.y0 + y));
  const std::int16_t* old_index = sources.state->index.data() + offset;
  row.count = row.removed_count = 0;
  if (sources.frame == nullptr) {
    for_each_pixel(mask, [&](int i) {
      if (!sources.takes(old_index[i])) return;
      Emission<lanes>& e = row.emissions[row.count++];
      e.x = x + i;
      e.index = old_index[i];
      colour_lanes<lanes, type>(old_colours[i], e.plus);
    });
    return;
  }
  const auto* new_colours =
      reinterpret_cast<const Pixel<type>*>(sources.frame->colour.pixel(window.x0 + x, window.y0 + y));
  const std::int16_t* new_index = sources.pending + offset;
  for_each_pixel(mask, [&](int i) {
    const bool same = old_index[i] == new_index[i];
    if (sources.takes(new_index[i])) {
      Emission<lanes>& e = row.emissions[row.count++];
      e.x = x + i;
      e.index = new_index[i];
      colour_lanes<lanes, type>((*sources.sanitiser)(new_colours[i]), e.plus);
      if (same) {
        colour_lanes<lanes, type>(old_colours[i], e.minus);
      } else {
        std::fill_n(e.minus, lanes, 0.0);
      }
    }
    if (!same && sources.takes(old_index[i])) {
      Emission<lanes>& r = row.removed[row.removed_count++];
      r.x = x + i;
      r.index = old_index[i];
      std::fill_n(r.plus, lanes, 0.0);
      colour_lanes<lanes, type>(old_colours[i], r.minus);
    }
  });
}

}  // namespace pullfocus
