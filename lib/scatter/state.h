// What sources are made of: a colour and a signed CoC index per pixel.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "image/frame.h"
#include "scatter/kernel_table.h"
#include "scatter/tile_work.h"

namespace pullfocus {

// Index of a pixel that has never been committed: it contributes nothing.
inline constexpr std::int16_t kNeverCommitted = std::numeric_limits<std::int16_t>::min();

// The per-pixel last state (Fearing 1996, section 4.1: I_l and C_l), sanitised.
struct SourceState {
  ColourImage colour;
  std::vector<std::int16_t> index;  // row by row over colour.window()

  void reset(const Window& window, SampleType type) {
    colour.reset(window, type);
    index.assign(window.pixels(), kNeverCommitted);
  }
};

// Work that covers a state's committed pixels, tile by tile.
std::vector<TileWork> whole_state(const SourceState& state);

// Run edges that scattering the whole state writes.
std::int64_t committed_edges(const SourceState& state, const KernelTable& kernels);

}  // namespace pullfocus
