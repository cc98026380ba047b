// Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error
// Visibility to Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004.
//
//   SSIM(x, y) = (2 mu_x mu_y + C1) (2 sigma_xy + C2) / ((mu_x^2 + mu_y^2 + C1) (sigma_x^2 + sigma_y^2 + C2))   (eq.
//   13)
//
// with means, variances and covariance under an 11x11 Gaussian of standard deviation 1.5 that sums to 1 (eqs 14-16),
// C1 = (0.01 L)^2, C2 = (0.03 L)^2. x and y are the luma of what a display shows: linear values clamped to 0..1,
// sRGB-encoded, Rec. 709 weights, so L = 1.
#pragma once

#include "image/frame.h"

namespace pullfocus {

inline constexpr int kSsimRadius = 5;

// SSIM of every pixel, -1..1; 1 where the surroundings are equal. Near the border the border's pixels go on outside.
// Throws Error(usage) if the window is empty.
Plane ssim_map(const ColourImage& picture, const ColourImage& reference, const Window& window);

// MSSIM (eq. 17): the mean over all pixels whose 11x11 pixels lie in the window; in a window without such pixels, over
// all of it.
double ssim(const ColourImage& picture, const ColourImage& reference, const Window& window);

}  // namespace pullfocus
