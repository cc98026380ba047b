// What a call left over, and how far the picture may still be from the exact one.
#pragma once

#include <cstdint>

namespace pullfocus {

struct LeftOver {
  std::int64_t pixels = 0;  // that wait
  double share = 0;         // of the picture, in tiles, that they can still change: 0..1
  // No sample of the picture differs from the exact one by more, scene-linear, apart from the rounding of either.
  // Thresholds, which leave changes alone for good, are not part of it (see FilterOptions::error_bound).
  double error_bound = 0;
};

}  // namespace pullfocus
