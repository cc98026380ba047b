// From the selected pixels of one tile row to sources. SIMD with run-time dispatch; every target gives the same bits.
#pragma once

#include <cstdint>
#include <limits>

#include "image/frame.h"
#include "image/sanitise.h"
#include "image/tiles.h"
#include "scatter/band.h"
#include "scatter/kernel_table.h"
#include "scatter/layers.h"
#include "scatter/state.h"

namespace pullfocus {

class Occlusion;

// What the selected pixels contribute.
struct Sources {
  const SourceState* state = nullptr;  // committed sources

  // Null: the committed state itself. Otherwise the change from it to this frame, whose new indices are
  // `pending` (row by row). Same window and sample type as the state.
  const Frame* frame = nullptr;
  const std::int16_t* pending = nullptr;
  const Sanitiser* sanitiser = nullptr;

  // Null: nothing is hidden. Otherwise goes with the state: what the sources of the state gave to pixels that hide them
  // is left out, and of a change it is put back, as if the state gave to all of them before the change. What the
  // change's own sources are hidden from is for a run over the new state to take out, with is_plain false.
  const Occlusion* occlusion = nullptr;
  bool is_plain = true;  // false: take out what is hidden, but do not scatter

  // Signed indices whose sources count; the others are left out.
  Layers::Range range{-kMostIndex + 1, kMostIndex};
  int least = 0;  // so are those of a smaller |index|
  static constexpr std::int16_t kMostIndex = std::numeric_limits<std::int16_t>::max();
};

// Columns that are written together, at most.
inline constexpr int kWindow = 8;

// What the pixels of a row contribute, lane by lane.
enum class RowKind {
  plain,       // round(plus * w) at weight w of the kernel
  recoloured,  // round(plus * w) - round(minus * w)
  moved        // round(plus * w) at weight w of the kernel, less round(minus * w) at weight w of the old one
};

// Pixels of one tile row as sources. Columns outside the mask hold anything.
template <int lanes>
struct SourceRow {
  static constexpr int kColumns = kTileWidth + kWindow;  // the last may be read, but are no sources

  int x = 0;                     // image column of column 0
  std::uint64_t mask = 0;        // bit i: column i is a source
  std::int16_t index[kColumns];  // whose kernels
  std::int16_t old[kColumns];    // of moved ones: at most KernelTable::kFarthestMove away
  alignas(64) double plus[kColumns * lanes], minus[kColumns * lanes];
};

// All that one tile row contributes. A pixel whose index changes by much is added at the new one, and its old colour,
// negated, at the old one: which takes it back to the last bit, as rounding to even is symmetric.
template <int lanes>
struct RowSources {
  SourceRow<lanes> added, taken_back, recoloured, moved;
};

// The lanes of one sane pixel.
template <int lanes, SampleType type>
void colour_lanes(const Pixel<type>& pixel, double* out) noexcept {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<double>(sample_value(pixel.rgba[c]));
  out[kWeightLane] = 1;
  if constexpr (lanes == kAlphaLanes) out[kAlphaLane] = static_cast<double>(sample_value(pixel.rgba[3]));
}

// Has what collect() will read of the tile row that begins at (x, y) fetched: pieces of rows are too short for
// processors to foresee.
void fetch_ahead(const Sources& sources, int x, int y) noexcept;

// Collects the pixels `mask` of the tile row that begins at (x, y), counted from the window's corner.
template <int lanes>
void collect(const Sources& sources, int x, int y, std::uint64_t mask, RowSources<lanes>& row) noexcept;

}  // namespace pullfocus
