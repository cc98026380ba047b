// Error measures between two pictures, all at once. Each has its source and equation in its own header:
//
//   differences.h   RMSE, PSNR, relative MSE, largest error      linear values
//   ssim.h          SSIM (Wang et al. 2004)                      display-encoded luma
//   flip.h          FLIP (Andersson et al. 2020)                 as seen at 67 pixels a degree
#pragma once

#include "metrics/differences.h"
#include "metrics/flip.h"
#include "metrics/ssim.h"

namespace pullfocus {

struct PictureErrors {
  Differences differences;
  double ssim = 1, flip = 0;
};

// `peak` > 0 is that of PSNR. Equal samples give exactly 0, and 1 for SSIM. May be called from several threads. Throws
// Error(usage) if the window is empty.
PictureErrors picture_errors(const ColourImage& picture, const ColourImage& reference, const Window& window,
                             double peak = 1);

}  // namespace pullfocus
