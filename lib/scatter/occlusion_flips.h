// Pixels that begin or cease to hide others.
#pragma once

#include <functional>
#include <vector>

#include "scatter/occlusion.h"
#include "scatter/scatter.h"

namespace pullfocus {

// For every pixel U of `tiles` whose depth key or CoC size differs between the committed state and the frame, and for
// every committed pixel P that is not in `tiles` and whose relation to U that flips: what P gives U, taken from U's
// sums where U begins to hide P, and added where it ceases to. `sources` is the change that is to be committed after
// this. `add(y, x, change)` is given `lanes` accumulators for U; rows come from several threads, those of one row of
// tiles from one.
using AddAtPixel = std::function<void(int y, int x, const Accumulator* change)>;
void correct_flips(const std::vector<TileWork>& tiles, const Sources& sources, DepthKind kind,
                   const KernelTable& kernels, int lanes, const AddAtPixel& add);

}  // namespace pullfocus
