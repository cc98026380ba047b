// From the masked pixels of one tile row to chunks of neighbouring sources that share a kernel.
#pragma once

#include <cmath>

#include "image/tiles.h"
#include "scatter/scatter.h"

namespace pullfocus {

// One source: contribution at weight w is round(plus * w) - round(minus * w), lane by lane.
template <int lanes>
struct Emission {
  int x;               // image column
  std::int16_t index;  // whose kernel
  double plus[lanes], minus[lanes];
};

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
      if (old_index[i] == kNeverCommitted) return;
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
    Emission<lanes>& e = row.emissions[row.count++];
    e.x = x + i;
    e.index = new_index[i];
    colour_lanes<lanes, type>((*sources.sanitiser)(new_colours[i]), e.plus);
    std::fill_n(e.minus, lanes, 0.0);
    if (old_index[i] == new_index[i]) {
      colour_lanes<lanes, type>(old_colours[i], e.minus);
    } else if (old_index[i] != kNeverCommitted) {
      Emission<lanes>& r = row.removed[row.removed_count++];
      r.x = x + i;
      r.index = old_index[i];
      std::fill_n(r.plus, lanes, 0.0);
      colour_lanes<lanes, type>(old_colours[i], r.minus);
    }
  });
}

// Up to `width` neighbouring columns from that of `first` on, of which those in `members` (bit i: sources[i]) share a
// kernel. Writes their change of contribution at every step of the kernel: step after step, width * lanes values, zero
// where no member is.
template <int lanes, int width, bool with_minus>
void step_values(const Kernel& kernel, const Emission<lanes>* sources, std::uint32_t members, int first_x,
                 Accumulator* out) noexcept {
  Accumulator at_level[256][lanes];
  std::fill_n(at_level[0], lanes, Accumulator{0});
  const std::size_t level_count = kernel.levels.size();
  if (std::popcount(members) < width) {
    std::fill_n(out, kernel.steps.size() * static_cast<std::size_t>(width * lanes), Accumulator{0});
  }
  for (; members != 0; members &= members - 1) {
    const Emission<lanes>& source = sources[std::countr_zero(members)];
    for (std::size_t k = 1; k < level_count; ++k) {
      const auto weight = static_cast<double>(kernel.levels[k]);
      for (int c = 0; c < lanes; ++c) {
        // Products are rounded to doubles and then to integers by the default mode: one value on every target.
        auto value = static_cast<Accumulator>(std::llrint(source.plus[c] * weight));
        if constexpr (with_minus) value -= static_cast<Accumulator>(std::llrint(source.minus[c] * weight));
        at_level[k][c] = value;
      }
    }
    Accumulator* values = out + (source.x - first_x) * lanes;
    for (const KernelStep& step : kernel.steps) {
      for (int c = 0; c < lanes; ++c) values[c] = at_level[step.high][c] - at_level[step.low][c];
      values += width * lanes;
    }
  }
}

}  // namespace pullfocus
