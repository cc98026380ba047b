// What one call of a filter did.
#pragma once

#include <cstdint>

namespace pullfocus {

enum class ScatterMode {
  unchanged,    // nothing was updated
  incremental,  // changes were scattered; or all, once, where earlier rebuilds had not kept the sums to add changes to
  rebuild       // every committed pixel was scattered
};

const char* name(ScatterMode mode) noexcept;

// Counts are repeatable for the same input and history; times are wall time in milliseconds and are not.
struct Stats {
  ScatterMode mode = ScatterMode::unchanged;
  std::int64_t changed = 0;    // pixels that differed from the committed state; always updated + left_over
  std::int64_t updated = 0;    // of these, pixels taken over
  std::int64_t left_over = 0;  // of these, pixels that wait for a later call
  std::int64_t edges = 0;      // run edges written (see scatter/kernel.h): of a change of index those of both kernels
  std::int64_t resolved = 0;   // result pixels computed
  std::int64_t slices = 0;     // pieces the work was done in: 1 unless the call could be stopped

  std::int64_t repaired_colour = 0;   // pixels with a NaN or infinite sample, taken as 0
  std::int64_t repaired_depth = 0;    // pixels with an invalid depth, taken as background
  std::int64_t clamped_radiance = 0;  // pixels beyond the largest radiance
  std::int64_t clamped_coc = 0;       // pixels beyond the largest CoC

  double detect_ms = 0, scatter_ms = 0, resolve_ms = 0;  // what is resolved on the way is within scatter_ms
  double filter_ms = 0;                                  // the whole call
  double overshoot_ms = 0;                               // by which the call missed the end of its time budget
};

}  // namespace pullfocus
