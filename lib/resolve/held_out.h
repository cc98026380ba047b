// Held-out pixels of the result.
#pragma once

#include "image/frame.h"
#include "scatter/state.h"

namespace pullfocus {

// Overwrites the held-out pixels of columns [x0, x1) of row y (from the window's corner) with their own committed
// colour, rounded to out's type and clamped to what a half can hold. Whatever was scattered onto them stays in the
// sums, where it is needed once the mask moves on, and is not shown. `out` covers state.colour.window().
void show_held_out(const SourceState& state, int x0, int x1, int y, ColourImage& out) noexcept;

// The same for the whole window. Runs in the calling task arena.
void show_held_out(const SourceState& state, ColourImage& out);

}  // namespace pullfocus
