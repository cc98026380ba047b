// Terms that many chains of a block have in common: they are added once, into a value row of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "scatter/block_plan.h"

namespace pullfocus {

struct PlannedTerm {
  std::uint16_t row;
  std::uint8_t shift;
  bool taken;  // else added
};

struct PlannedChain {
  std::int16_t dx, dy;
  int spread;  // columns from the first term's to the last one's
  std::vector<PlannedTerm> terms;
};

// Replaces pairs of terms of the same sign that lie as far apart in many chains by rows of their sums: these are
// BlockPlan::wide, and count from BlockPlan::kMostRows on.
std::vector<BlockPlan::RowSum> share_terms(std::vector<PlannedChain>& chains);

}  // namespace pullfocus
