// The aperture of a lens with straight or curved blades: a flat regular polygon.
//
// Its corners lie on the circle of the CoC's diameter: that is what Blender Cycles samples (a regular polygon inscribed
// in the lens), so a filtered frame matches one rendered with the same blades. A blade is the arc of curvature
// roundness / R through two neighbouring corners: 0 is the straight edge, 1 the circle itself, and every shape in
// between is convex. The shape is the intersection of one disc (or half-plane) a blade, so each row is one run.
//
// Weight of a pixel = share of its area inside, in L levels, off by at most 1 / (2 L):
//
//     diameter   < 12   < 16   < 64   < 160   from 160 px on
//     L            16      8      4       2      1
//
// (the smaller diameter where pixels are not square). These are more than the disc has: a straight edge along the pixel
// grid would jump by a whole pixel at once. Second moments per axis, against the polygon's over square pixels: within
// 10 % from 4 px on, 4.5 % from 8, 2 % from 32. Below 2 px the kernel is mixed with the identity (density.h). Cost:
// about (2, 3.4, 4.5) x diameter edges a source for L = 1, 2, 4 or more; less where the polygon is not as high as the
// disc.
#pragma once

#include "scatter/kernel.h"
#include "scatter/kernel_shape.h"

namespace pullfocus {

// Upright, as it shows behind focus. diameter_px in [0, 500], horizontal; pixel_aspect = pixel width / height. Blades,
// rotation and roundness are those of `shape`.
Kernel polygon_kernel(double diameter_px, double pixel_aspect, const KernelShape& shape);

}  // namespace pullfocus
