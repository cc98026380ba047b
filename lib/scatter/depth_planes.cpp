#include "scatter/depth_planes.h"

#include <algorithm>

#include "scatter/depth_key.h"

namespace pullfocus {

void DepthPlanes::reset(int width, int height) {
  width_ = width;
  height_ = height;
  const std::size_t values = static_cast<std::size_t>(width + 2 * kMargin) * static_cast<std::size_t>(height);
  keys_.assign(values, kBackgroundKey);
  sizes_.assign(values, 0);
}

void DepthPlanes::mirror_margins(int y) noexcept {
  for (std::uint16_t* row : {keys(y), sizes(y)}) {
    for (int i = 1; i <= kMirrored; ++i) {
      row[-i] = row[mirror(-i, width_)];
      row[width_ - 1 + i] = row[mirror(width_ - 1 + i, width_)];
    }
  }
}

}  // namespace pullfocus
