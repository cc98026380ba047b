// Settings of a filter. What holds for all of them: defaults are usable, validate() names what is wrong.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "image/sample.h"
#include "importance/importance.h"
#include "scatter/kernel_table.h"
#include "scatter/visibility.h"

namespace pullfocus {

// How many of the changed pixels, left-overs included, one frame may update, or how long it may take.
struct Budget {
  enum class Kind { percent, count, time };
  Kind kind = Kind::percent;
  double amount =
      100;  // percent in (0, 100], pixels >= 0, or milliseconds > 0 from the beginning of the call to its end

  // All of them under a time budget: what is not done by then is left over.
  std::int64_t pixels(std::int64_t changed) const noexcept;

  // A percentage promises that no change waits for more than so many calls, ceil(200 / percent); 0: no promise.
  int longest_wait() const noexcept;

  // "15%", "200000" or "40ms". Throws Error(usage) naming --budget.
  static Budget parse(std::string_view text);
};

// Milliseconds since any fixed time.
using Clock = std::function<double()>;

struct FilterOptions {
  KernelOptions kernel;
  VisibilityOptions visibility;
  ImportanceOptions importance;
  ChangeThresholds thresholds;  // IncrementalFilter only; linear takes every change
  Budget budget;                // IncrementalFilter only; the first frame is done in full, except under a time budget
  double error_bound = 0;  // IncrementalFilter only: every sample of the result is allowed to differ from the linear
                           // filter's by this (scene-linear, plus 1e-7 and the rounding of the result); >= 0. Leaves
                           // changes of colour alone accordingly; needs a full budget and no other thresholds
  std::optional<SampleType> output_type;  // of the result; nullopt: the frame's own
  int threads = 0;                        // >= 1, or 0 for all processors
  std::int64_t slice_edges = 1 << 20;     // most work between two looks at a stop request, in run edges, >= 1; slices
                                          // of a time budget without such requests: up to 8 times; where calls without
                                          // one have rebuilt every frame, the first slice of a call with one may take
                                          // as long as a rebuild
  Clock clock;                            // for time budgets; empty: the steady clock
};

// Throws Error(usage).
void validate(const FilterOptions& options);

}  // namespace pullfocus
