// What left-over pixels can still change, and how important they are.
#pragma once

#include <vector>

#include "filter/left_over.h"
#include "importance/order.h"
#include "scatter/scatter.h"

namespace pullfocus {

// Every pixel of the picture is a convex combination of the colours that reach it, before and after: it can change by
// no more than their range, and only where a waiting pixel's old or new kernel reaches. Taken by tile, with the largest
// kernel of all. `fill`: pixels beyond the kernels whose colour may fill holes (Backdrop::kReach with layers, else 0).
// Runs in the calling task arena.
LeftOver assess(const std::vector<TileWork>& left, const Pending& pending, const Scatter& scatter, int fill);

// Writes the priority of each waiting pixel to `out`, which is set to the window, and 0 everywhere else; infinite for
// pixels never committed.
void importance_of(const std::vector<TileWork>& left, const Pending& pending, const ImportanceOptions& options,
                   Plane& out);

}  // namespace pullfocus
