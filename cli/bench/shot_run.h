// A whole shot through both filters, frame by frame in turn.
#pragma once

#include <vector>

#include "bench/timing.h"
#include "camera/thin_lens.h"
#include "filter/options.h"
#include "image/frame.h"

namespace pullfocus::cli::bench {

// Wall time of filtering, ms: of the first frame, and summed over all others.
struct ShotTimes {
  double first = 0, rest = 0;
  double all() const noexcept { return first + rest; }
};

struct ShotRun {
  ShotTimes linear, incremental;
};

// Both filters with the same options, each from its first frame on. `coc` is of every frame.
ShotRun run_shot(const std::vector<Frame>& frames, const std::vector<CocFunction>& coc, const FilterOptions& options);

// Times a frame after the first, and how many times faster: medians over runs of the whole shot.
struct ShotSpeed {
  double linear_ms = 0, incremental_ms = 0;  // mean over frames
  Spread without_first{};                    // linear / incremental
  Spread with_first{};
};
ShotSpeed speed_of(const std::vector<Frame>& frames, const std::vector<CocFunction>& coc, const FilterOptions& options,
                   int runs);

}  // namespace pullfocus::cli::bench
