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
  double share = 0;  // of the pixel's result, 0..1; all contributors' shares sum to 1
  float coc_px = 0;  // its signed diameter
  int layer = 0;     // 0: the nearest
  float depth = 0;
  bool background = false;
};

// What one layer gives the pixel (see resolve/resolve.h); without layers there is one.
struct LayerShare {
  double coc_first = 0, coc_last = 0;  // signed table diameters of its sources lie between these, pixels
  double weight = 0;                   // summed over its sources; 1 covers the pixel
  double share = 0;                    // of the result, 0..1
};

struct Explanation {
  float depth = 0;          // as read
  bool background = false;  // taken as: no surface, at infinity
  bool held_out = false;    // by the frame's mask: the pixel shows its own colour, whatever covers it
  float coc_px = 0;         // signed diameter, before quantisation
  int index = 0;            // in the table
  double diameter_px = 0;   // of the kernel used
  double own_share = 0;     // of the pixel's result that is its own colour
  double total_weight = 0;  // over all layers; 1 where every source around has the same CoC
  double filled_share = 0;  // of the result, from what is seen behind the foreground around (see resolve/backdrop.h)
  std::int64_t contributors = 0;     // that cover the pixel itself
  std::vector<LayerShare> layers;    // those that have sources here, nearest first
  std::vector<Contributor> largest;  // those of the filled share included; by share, then nearest row and column
};

// Pixel (x, y) in window coordinates, inside frame.window(); the `most` largest contributors. Exact: the same
// weights, mirrored at the same borders, with bitmaps hidden at the same offsets, and with layers accepted and holes
// filled as by the filter: the sum of share times colour is the pixel of the result. Throws as validate() of the
// visibility does.
Explanation explain(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, int x, int y,
                    std::size_t most, const VisibilityOptions& visibility = {});

}  // namespace pullfocus
