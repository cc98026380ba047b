// From accumulators to pixels.
#pragma once

#include "image/frame.h"
#include "scatter/band.h"

namespace pullfocus {

// Divides numerators by weights for pixels [x0, x1) of row y (from the window's corner) and stores them in
// `out`. `values` points at column x0, `lanes` accumulators a pixel; without an alpha lane, alpha is 1. A
// pixel of weight zero takes the colour of `own` (same window), rounded to out's type. half results are
// clamped to +-65504: a finite input never becomes infinite.
void resolve_span(const Accumulator* values, int lanes, int x0, int x1, int y, const ColourImage& own,
                  ColourImage& out) noexcept;

}  // namespace pullfocus
