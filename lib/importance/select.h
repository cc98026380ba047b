// Which of the changed pixels a budget affords.
#pragma once

#include <cstdint>
#include <vector>

#include "importance/order.h"
#include "importance/waiting.h"

namespace pullfocus {

// What a budget affords.
struct Allowance {
  std::int64_t pixels = 0;  // half of them go to those that wait longest, if any wait
  int longest_wait = 0;     // a pixel that has waited so many calls is served in any case; 0: no such promise
};

// The changed pixels to update: the half of the allowance that serves those that have waited longest, and for the
// rest of it the most important ones. Ties go by importance, then by scrambled position. Deterministic, whatever the
// threads. Pixels never committed are more important than all others.
std::vector<TileWork> select_pixels(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                    const WaitingTimes& waiting, const Allowance& allowance);

}  // namespace pullfocus
