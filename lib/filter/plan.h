// What filtering a shot will model, and what that costs: known before the first frame is filtered. A plan
// describes; it never changes a result.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "camera/thin_lens.h"
#include "filter/options.h"
#include "image/frame.h"

namespace pullfocus {

struct Plan {
  Window window;                   // state window
  bool alpha = false;              // alpha is accumulated: some pixel's is not exactly 1
  float coc_min = 0, coc_max = 0;  // signed diameters in pixels over the frame, unclamped
  int index_min = 0, index_max = 0;
  int table_size = 0;             // kernels in the table, signs counted once
  std::int64_t background = 0;    // pixels without a surface
  std::int64_t held_out = 0;      // pixels that the mask takes out
  std::int64_t clamped_coc = 0;   // pixels beyond the largest CoC
  std::int64_t linear_edges = 0;  // run edges of a linear frame

  int tiles = 0, bitmap_tiles = 0;  // of 64 x 16 pixels; those in which something may be hidden (with bitmaps)
  std::int64_t bitmap_pixels = 0;   // pixels whose bitmap is looked at

  struct Layer {
    double coc_first = 0, coc_last = 0;  // signed table diameters of its sources may lie between these, pixels
    std::int64_t pixels = 0;             // sources
    double reached = 0;                  // share of the window's tiles that hold its sums
  };
  std::vector<Layer> layers;  // with sources, nearest first; one alone without layers

  double state_bytes_per_pixel = 0;  // the filter's own: sums, committed state, masks
  double frame_bytes_per_pixel = 0;  // input frame and result

  std::optional<double> changed_share;     // of pixels from this frame to the next one, if one was given
  std::optional<std::int64_t> next_edges;  // run edges that change writes
};

// Looks at one frame, and for the prediction at the one after it (null: none). Throws as a filter would.
Plan make_plan(const FilterOptions& options, const KernelTable& kernels, const Frame& frame, const CocFunction& coc,
               const Frame* next, const CocFunction& next_coc);

}  // namespace pullfocus
