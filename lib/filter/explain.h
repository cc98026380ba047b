// The story of one pixel of the result.
#pragma once

#include <cstdint>
#include <vector>

#include "camera/thin_lens.h"
#include "image/frame.h"
#include "scatter/kernel_table.h"
#include "scatter/visibility.h"

namespace pullfocus {

// A source that reaches the pixel.
struct Contributor {
  int x = 0, y = 0;
  double share = 0;  // of the pixel's total weight, 0..1
  float coc_px = 0;  // its signed diameter
  float depth = 0;
  bool background = false;
};

struct Explanation {
  float depth = 0;          // as read
  bool background = false;  // taken as: no surface, at infinity
  float coc_px = 0;         // signed diameter, before quantisation
  int index = 0;            // in the table
  double diameter_px = 0;   // of the kernel used
  double own_share = 0;     // of the pixel's weight that is its own
  double total_weight = 0;  // 1 where every source around has the same CoC
  std::int64_t contributors = 0;
  std::vector<Contributor> largest;  // by share, then nearest row and column
};

// Pixel (x, y) in window coordinates, inside frame.window(); the `most` largest contributors. Exact: the same
// weights, mirrored at the same borders, and with bitmaps hidden at the same offsets, as the filter's.
Explanation explain(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, int x, int y,
                    std::size_t most, const VisibilityOptions& visibility = {});

}  // namespace pullfocus
