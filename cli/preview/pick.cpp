#include "preview/pick.h"

#include <algorithm>
#include <limits>

#include "camera/depth_repair.h"

namespace pullfocus::cli::preview {

double focus_distance_at(const Frame& frame, DepthKind kind, int x, int y) {
  constexpr int around = 16;  // pixels, enough to see the surfaces that a mixed depth lies between
  const Window& w = frame.window();
  const Window part{std::max(w.x0, x - around), std::max(w.y0, y - around), std::min(w.x1, x + around + 1),
                    std::min(w.y1, y + around + 1)};
  Frame crop{ColourImage(part, frame.colour.type()), Plane(part, 0), frame.has_alpha, {}};
  for (int row = part.y0; row < part.y1; ++row) {
    std::copy_n(frame.colour.pixel(part.x0, row), crop.colour.row_bytes(), crop.colour.pixel(part.x0, row));
    std::copy_n(&frame.depth.at(part.x0, row), part.width(), crop.depth.row(row));
  }
  repair_depth(crop, kind);
  const float depth = crop.depth.at(x, y);
  return is_background(kind, depth) ? std::numeric_limits<double>::infinity() : static_cast<double>(depth);
}

}  // namespace pullfocus::cli::preview
