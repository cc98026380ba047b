#include "metrics/planes.h"

#include "image/error.h"
#include "image/srgb.h"

namespace pullfocus {

std::array<Grid, 3> displayable_planes(const ColourImage& picture, const Window& window) {
  std::array<Grid, 3> planes{Grid(window), Grid(window), Grid(window)};
  const Window common = intersect(picture.window(), window);
  for (int y = common.y0; y < common.y1; ++y) {
    for (int x = common.x0; x < common.x1; ++x) {
      for (int c = 0; c < 3; ++c) {
        planes[static_cast<std::size_t>(c)].at(x, y) = static_cast<double>(displayable(picture.get(x, y, c)));
      }
    }
  }
  return planes;
}

Grid display_luma(const ColourImage& picture, const Window& window) {
  Grid luma(window);
  const Window common = intersect(picture.window(), window);
  for (int y = common.y0; y < common.y1; ++y) {
    for (int x = common.x0; x < common.x1; ++x) {
      const auto shown = [&](int c) { return static_cast<double>(srgb_encoded(displayable(picture.get(x, y, c)))); };
      luma.at(x, y) = 0.2126 * shown(0) + 0.7152 * shown(1) + 0.0722 * shown(2);
    }
  }
  return luma;
}

void require_pixels(const Window& window) {
  if (window.empty()) throw Error(ErrorCode::usage, "pictures cannot be compared over an empty window");
}

double mean(const Plane& map, const Window& part) {
  double sum = 0;
  for (int y = part.y0; y < part.y1; ++y) {
    double row = 0;
    for (int x = part.x0; x < part.x1; ++x) row += static_cast<double>(map.at(x, y));
    sum += row;
  }
  return sum / static_cast<double>(part.pixels());
}

}  // namespace pullfocus
