// FLIP for low dynamic range pictures: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D.
// Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020
// (with its erratum: c_x, c_z divide by 116, not 100). What one notices when flipping between two pictures:
//
//   colour   (section 4.1) filter both with the eye's contrast sensitivity in YyCxCz, clamp to RGB 0..1, Hunt-adjusted
//            L*a*b*, HyAB distance to the power 0.7, redistributed to 0..1                           -> dE_c
//   feature  (section 4.2) edges and points of Yy by derivatives of a Gaussian of 0.041 degrees; the larger difference
//            of their magnitudes, over sqrt 2, to the power 0.5                                      -> dE_f
//   FLIP   = dE_c ^ (1 - dE_f)
//
// Values are clamped to 0..1 (NaN to 0), linear; nothing is rounded to 8 bits.
#pragma once

#include "image/frame.h"

namespace pullfocus {

// The paper's default: a 0.7 m wide display of 3840 pixels seen from 0.7 m, 67 pixels a degree.
inline constexpr double kFlipPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

// FLIP of every pixel, 0..1; 0 where nothing differs within reach. Reach: ceil(0.135 pixels_per_degree) pixels, 10 by
// default; the border's pixels go on outside. pixels_per_degree in [1, 1000]. Runs on the calling arena's threads; the
// result does not depend on their number. Throws Error(usage).
Plane flip_map(const ColourImage& picture, const ColourImage& reference, const Window& window,
               double pixels_per_degree = kFlipPixelsPerDegree);

// The mean of the map, as the authors recommend since.
double flip(const ColourImage& picture, const ColourImage& reference, const Window& window,
            double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace pullfocus
