// What sources are made of: a colour and a signed CoC index per pixel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "image/frame.h"
#include "scatter/kernel_table.h"
#include "scatter/tile_work.h"

namespace pullfocus {

// Index of a pixel that has never been committed: it contributes nothing.
inline constexpr std::int16_t kNeverCommitted = std::numeric_limits<std::int16_t>::min();

// Index of a held-out pixel (Frame::mask): it contributes nothing either, and shows its own colour.
inline constexpr std::int16_t kHeldOut = kNeverCommitted + 1;

// Whether a pixel of this index contributes to anything; only then does it name a kernel.
inline bool is_source(std::int16_t index) noexcept { return index > kHeldOut; }

// |index| of a source; 0, which reaches the pixel alone, for all others.
inline int reach_index(std::int16_t index) noexcept { return is_source(index) ? std::abs(int{index}) : 0; }

// The largest of n indices.
inline int largest_reach(const std::int16_t* index, int n) noexcept {
  std::int16_t low = 0, high = 0;
  for (int i = 0; i < n; ++i) {  // simple enough for the compiler to use vectors
    const std::int16_t of_source = is_source(index[i]) ? index[i] : std::int16_t{0};
    low = std::min(low, of_source);
    high = std::max(high, of_source);
  }
  return std::max(-low, int{high});
}

// The smallest and the largest of some indices.
struct IndexBounds {
  int least, most;

  int largest() const noexcept { return std::max(std::abs(least), std::abs(most)); }  // |index|
};

// Of kTileWidth indices.
inline IndexBounds bounds_of_tile_row(const std::int16_t* index) noexcept {
  std::int16_t low = index[0], high = index[0];
  for (int i = 1; i < kTileWidth; ++i) {  // simple enough for the compiler to use vectors
    low = std::min(low, index[i]);
    high = std::max(high, index[i]);
  }
  return {low, high};
}

// The per-pixel last state (Fearing 1996, section 4.1: I_l and C_l), sanitised.
struct SourceState {
  ColourImage colour;
  std::vector<std::int16_t> index;  // row by row over colour.window()
  bool may_hold_out = false;        // false: no index is kHeldOut

  void reset(const Window& window, SampleType type) {
    colour.reset(window, type);
    index.assign(window.pixels(), kNeverCommitted);
    may_hold_out = false;
  }
};

// Work that covers a state's committed pixels, held-out ones included, tile by tile.
std::vector<TileWork> whole_state(const SourceState& state);

}  // namespace pullfocus
