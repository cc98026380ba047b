// The flat disc: the intensity distribution of an ideal, fully open lens (Potmesil and Chakravarty 1981
// without diffraction; Fearing 1996, section 4.2).
//
// Weight of a pixel = share of its area inside the disc, in L levels:
//     diameter   < 12   < 16   < 20   < 40   from 40 px on
//     L            16      8      3      2      1
// A level more costs a good half again as much per source; a hard rim keeps within the bound below from 32 px on,
// and from 40 px on it costs no accuracy against path-traced truth that could be measured.
// The disc's own diameter is adjusted by at most 0.3 px so that the second moment per axis is that of the
// true disc over square pixels, D^2/16 + 1/12, within 1 % from 8 px on. Below 2 px the kernel is the 2 px
// disc mixed with the identity, share D^2/4, so that blur sets in smoothly: the second moment grows as D^2
// from 0 at D = 0. Cost: about (2, 3.2, 4, 5) x diameter edges a source for L = 1, 2, 4, 8 or 16.
#pragma once

#include "scatter/kernel.h"

namespace pullfocus {

// diameter_px in [0, 500], horizontal, a multiple of 1/16. pixel_aspect = pixel width / height: the vertical
// diameter is diameter_px * pixel_aspect.
Kernel disc_kernel(double diameter_px, double pixel_aspect = 1);

}  // namespace pullfocus
