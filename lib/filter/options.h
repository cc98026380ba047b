// Settings of a filter. What holds for all of them: defaults are usable, validate() names what is wrong.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "image/sample.h"
#include "importance/importance.h"
#include "scatter/kernel_table.h"

namespace pullfocus {

// How many of the changed pixels, left-overs included, one frame may update.
struct Budget {
  enum class Kind { percent, count };
  Kind kind = Kind::percent;
  double amount = 100;  // percent in (0, 100], or pixels >= 0

  std::int64_t pixels(std::int64_t changed) const noexcept;

  // A percentage promises that no change waits for more than so many calls, ceil(200 / percent); 0: no promise.
  int longest_wait() const noexcept;

  // "15%" or "200000". Throws Error(usage) naming --budget.
  static Budget parse(std::string_view text);
};

struct FilterOptions {
  KernelOptions kernel;
  ImportanceOptions importance;
  ChangeThresholds thresholds;            // IncrementalFilter only; linear takes every change
  Budget budget;                          // IncrementalFilter only; its first frame is done in full
  std::optional<SampleType> output_type;  // of the result; nullopt: the frame's own
  int threads = 0;                        // >= 1, or 0 for all processors
  std::int64_t slice_edges = 1 << 20;     // work between two looks at a stop request, in run edges, >= 1
};

// Throws Error(usage).
void validate(const FilterOptions& options);

}  // namespace pullfocus
