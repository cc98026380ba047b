// Plain twins of the filter, written for reading: every result of the library is held against these.
#pragma once

#include <vector>

#include "filter/incremental_filter.h"

namespace pullfocus::test {

// Where a coordinate lands in [0, size) after reflection at the borders.
int reflect(int x, int size);

// What the accumulators must hold: for every committed source and every pixel of its kernel, round(I * w) added where
// it lands after mirroring at the borders. O(R^2) a source, no runs, no bands, no deltas.
// With `layers`, of the sources of one of them only.
std::vector<Accumulator> exact_sums(const SourceState& state, const KernelTable& kernels, int lanes,
                                    const Layers* layers = nullptr, int layer = 0);

// Whether the accumulators of every layer are those of the committed state, bit for bit.
bool invariant_holds(const IncrementalFilter& filter, const KernelTable& kernels);

// The linear filter in plain floating point, from the frame: double sums of colour * weight, divided by the sum of
// weights. Handles any colours and depths; alpha is a channel like the others.
struct NaiveImage {
  Window window;
  std::vector<double> rgba;
  double at(int x, int y, int c) const {
    return rgba[(static_cast<std::size_t>(y - window.y0) * window.width() + (x - window.x0)) * 4 + c];
  }
};
NaiveImage naive_scatter(const Frame& frame, const CocFunction& coc, const KernelTable& kernels);

// First difference of two images in words, or empty: type, window, then pixels by their bits.
std::string difference(const ColourImage& a, const ColourImage& b);

}  // namespace pullfocus::test
