// Shots that are hard on an incremental filter, and what becomes of them in float32 and in the filter.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "camera/thin_lens.h"
#include "image/frame.h"

namespace pullfocus::test {

struct HardShot {
  std::string name;
  Window window;
  double max_coc_px;
  int frames;
  // Writes frame f, a function of f alone; may change the lens.
  std::function<void(int f, Frame& frame, CocFunction& coc)> at;
};

// In the order of the table.
const std::vector<HardShot>& hard_shots();
std::ostream& operator<<(std::ostream& out, const HardShot& shot);

// How one way of summing took a shot.
struct Outcome {
  double error = 0;             // largest |is - true| / max(|true|, 1e-6), over the frames looked at
  std::int64_t not_finite = 0;  // most samples of one frame that are NaN or infinite
  bool same_bits = false;       // sums and picture when frame 0 comes again, against those of its first time
};

struct Comparison {
  Outcome float32, filter;
  double share_of_bound = 0;  // largest error of the filter, in units of what its rounding allows
  bool exact = true;          // the filter's sums were the true integers whenever looked at
};

// Runs all frames, then frame 0 again; looks at about eight frames in between and at the last one.
Comparison compare(const HardShot& shot, int threads);

// A number in [low, high) that depends on these four alone.
float uniform(unsigned seed, int frame, int pixel, int what, float low, float high);

}  // namespace pullfocus::test
