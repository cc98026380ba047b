// The aperture of a lens with straight or curved blades: a flat regular polygon.
//
// Its corners lie on the circle of the CoC's diameter: that is what Blender Cycles samples (a regular polygon inscribed
// in the lens), so a filtered frame matches one rendered with the same blades. A blade is the arc of curvature
// roundness / R through two neighbouring corners: 0 is the straight edge, 1 the circle itself, and every shape in
// between is convex. The shape is the intersection of one disc (or half-plane) a blade, so each row is one run.
//
// Weight of a pixel = share of its area inside, in 16, 8, 3, 2 or 1 levels, by the same diameters as the disc (disc.h);
// the smaller one counts where pixels are not square. With one level no pixel is off by more than half its area. Second
// moments are within 2 % of the polygon's from 12 px on. Below 2 px the kernel is mixed with the identity (density.h).
// Cost: that of the disc times the polygon's height over its diameter.
#pragma once

#include "scatter/kernel.h"
#include "scatter/kernel_shape.h"

namespace pullfocus {

// Upright, as it shows behind focus. diameter_px in [0, 500], horizontal; pixel_aspect = pixel width / height. Blades,
// rotation and roundness are those of `shape`.
Kernel polygon_kernel(double diameter_px, double pixel_aspect, const KernelShape& shape);

}  // namespace pullfocus
