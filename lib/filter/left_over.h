// What a call left over, and how far the picture may still be from the exact one.
#pragma once

#include <cstdint>
#include <vector>

#include "importance/order.h"
#include "scatter/scatter.h"

namespace pullfocus {

struct LeftOver {
  std::int64_t pixels = 0;  // that wait
  double share = 0;         // of the picture, in tiles, that they can still change: 0..1
  // No sample of the picture differs from the exact one by more, scene-linear, apart from the rounding of either.
  // Thresholds, which leave changes alone for good, are not part of it (see FilterOptions::error_bound).
  double error_bound = 0;
};

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
