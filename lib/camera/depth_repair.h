// Antialiased depth: finding pixels whose depth a filter mixed from two surfaces, and giving them one of the two.
//
// Renderers that filter depth as they do colour store a z1 + (1 - a) z2 at silhouettes: a false surface between two
// real ones, which blurs by another amount than either and shows as a rim. A pixel counts as mixed if, along its row,
// column or a diagonal,
//
//   - at most three pixels, itself among them, lead monotonically from one smooth surface to another;
//   - those two are at least 5 % apart in inverse depth (planar) or 1 px in CoC (coc);
//   - it is clear of both: of the surface itself, and of where the surface would go on to, with room for curvature;
//
// and if no surface leads on to it along any of the lines: two pixels in a row that are not mixed, and a step from them
// of at most 2.5 times their own (and once more from such pixels). Planes are linear in inverse depth over the picture,
// in perspective, so whatever their slant they are never clear of themselves; at a sphere's rim, where depth falls as
// the square root of the distance to it, the last step is at most 1 + sqrt(2) times the one before.
//
// Empty pixels are a surface too as long as their value is finite (0, or 1e9 and more): filters mix those values in as
// well. What is invalid (negative, NaN, infinite) is never mixed and never taken from.
//
// A true strip of depth one to three pixels wide between a nearer surface and a farther one has the same depths as an
// edge that was filtered: it counts as mixed.
#pragma once

#include <cstdint>

#include "camera/depth.h"
#include "image/frame.h"

namespace pullfocus {

struct DepthEdges {
  std::int64_t mixed = 0;  // pixels as above
  std::int64_t sharp = 0;  // steps along rows and columns from one such surface to the other, nothing between

  // First-hit depth has few mixed pixels; filtered depth has them wherever an edge crosses a pixel.
  double share() const noexcept {
    return mixed > 0 ? static_cast<double>(mixed) / static_cast<double>(mixed + sharp) : 0;
  }
  bool look_antialiased() const noexcept { return mixed >= 16 && share() >= 0.3; }
};

// Reads depth and alpha. Threads: runs in the calling task arena; the result does not depend on their number.
DepthEdges find_depth_edges(const Frame& frame, DepthKind kind);

// Gives every mixed pixel the stored depth of one of the two surfaces, by their shares a : 1 - a in the mixture: the
// larger one's. A pixel with alpha < 1 at an empty one carries the surface's colour alone: where its share is its alpha
// (within 0.1; the depth unpremultiplied is then the surface's), it gets the surface's depth however small that is,
// else it is left alone. Repeated until no pixel is mixed (at most 16 times), so that repairing again changes nothing.
// Returns how many pixels changed. Nothing else of the frame is touched. Threads as above.
std::int64_t repair_depth(Frame& frame, DepthKind kind);

}  // namespace pullfocus
