// The gaussian intensity distribution (Fearing 1996, sections 4.2 and 6, whose experiments used it).
//
//     w(x, y) ~ exp(-(x^2 + y^2) / (2 s^2)) averaged over the pixel, for pixels with centres within 3 s
//
// Cut at 3 s, a gaussian keeps 0.9494 of its variance, so s is 1.02628 D/4: the standard deviation of the kernel is D/4
// per axis, which is that of the disc of diameter D. Footprint: 1.54 x D across.
//
// At most 16 levels, spaced evenly in density^(2/3): no pixel is off by more than 5 % of the peak. Second moments are
// within 1 % of D^2/16 + 1/12 from 12 px on, 4 % from 4 px. Below 2 px the kernel is mixed with the identity
// (density.h). Cost: about 25 x diameter edges a source, 12 times the disc's.
#pragma once

#include "scatter/kernel.h"

namespace pullfocus {

// diameter_px in [0, 500], horizontal; pixel_aspect = pixel width / height.
Kernel gaussian_kernel(double diameter_px, double pixel_aspect = 1);

}  // namespace pullfocus
