// From accumulators to pixels.
#pragma once

#include <span>

#include "image/frame.h"
#include "resolve/backdrop.h"
#include "scatter/band.h"
#include "scatter/kernel.h"
#include "scatter/scatter.h"

namespace pullfocus {

// Divides numerators by weights for pixels [x0, x1) of row y (from the window's corner) and stores them in
// `out`. `values` points at column x0, `lanes` accumulators a pixel; without an alpha lane, alpha is 1. A
// pixel of weight zero takes the colour of `own` (same window), rounded to out's type. half results are
// clamped to +-65504: a finite input never becomes infinite. Returns whether every pixel had weight.
bool resolve_span(const Accumulator* values, int lanes, int x0, int x1, int y, const ColourImage& own,
                  ColourImage& out) noexcept;

// Weight that covers a pixel where several layers meet: 15/16 of kWeightUnit. Where its CoC changes from pixel to
// pixel, a surface's weights sum to somewhat less than one unit here and more there, and through the gaps a layer
// behind it would shine (measured in docs/visibility.md).
inline constexpr std::int64_t kCoveringWeight = kWeightUnit / 16 * 15;

// The same from the sums of several layers, nearest first (null: nothing has reached there). With weights in units of
// kCoveringWeight, each layer gives at most what those before it have left free (after DESIGN section 6):
//
//   accepted_i = min(weight_i, 1 - sum of accepted before)       colour = sum accepted_i num_i / weight_i
//
// and what is still free after the last goes to the farthest layer that reaches the pixel: what is hidden behind a
// blurred foreground is most likely more of what lies behind it (measured in docs/visibility.md). So a sharp near
// surface lets nothing through, a blurred one lets the rest through, and a surface that a layer's border cuts keeps its
// whole weight. A pixel that one layer alone reaches is num / weight, with the bits that resolve_span() gives. At most
// kMostLayers layers.
//
// The first `near` of the layers lie in front of focus. Where there is a `backdrop`, it is told of every pixel what is
// seen behind them, in chunks from x0, a multiple of Backdrop::kChunk, on; its fill() is then to be called.
inline constexpr std::size_t kMostLayers = 16;
bool resolve_layers(std::span<const Accumulator* const> layers, int lanes, int x0, int x1, int y,
                    const ColourImage& own, ColourImage& out, std::size_t near = 0, Backdrop* backdrop = nullptr);

// The whole row from rows as Scatter hands them over, those of layers below `near` in front of focus. Where no layer
// has a span a pixel has no weight.
void resolve_rows(std::span<const LayerRow> rows, int lanes, int y, const ColourImage& own, ColourImage& out,
                  int near = 0, Backdrop* backdrop = nullptr);

}  // namespace pullfocus
