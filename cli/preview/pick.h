// What an artist means by clicking on a pixel.
#pragma once

#include "camera/depth.h"
#include "image/frame.h"

namespace pullfocus::cli::preview {

// The distance to focus on for pixel (x, y) of the frame's window: its depth; where a filter mixed that from two
// surfaces (see camera/depth_repair.h), the depth of the surface it belongs to; infinite for background. Not for
// DepthKind::coc.
double focus_distance_at(const Frame& frame, DepthKind kind, int x, int y);

}  // namespace pullfocus::cli::preview
