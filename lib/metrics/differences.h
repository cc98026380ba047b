// Errors from the plain differences of samples, scene-linear.
#pragma once

#include "image/frame.h"

namespace pullfocus {

// With a the picture, b the reference, and means over R, G and B of all pixels of a window:
struct Differences {
  double mse = 0;           // mean of (a - b)^2, values as they are
  double shown_mse = 0;     // the same with both clamped to 0..peak, NaN to 0
  double relative_mse = 0;  // mean of (a - b)^2 / (b^2 + 0.01): Rousselle, Knaus and Zwicker, "Adaptive Sampling and
                            // Reconstruction using Greedy Error Minimization", 2011, with a larger constant
  double largest = 0;       // largest |a - b|; of R, G, B and A

  double rmse() const noexcept;

  // 10 log10(peak^2 / shown_mse) in dB, +infinity without error: of what a display that ends at `peak` shows, so that a
  // few lamps do not decide. With all values in 0..peak it is the plain PSNR.
  double psnr(double peak) const noexcept;
};

// Samples outside a picture's window count as 0. NaN in either picture (not: equal infinities) makes mse, relative_mse
// and largest NaN. `peak` > 0. Throws Error(usage) if the window is empty or the peak is out of range.
Differences differences(const ColourImage& picture, const ColourImage& reference, const Window& window,
                        double peak = 1);

// Per pixel: root of the mean of (a - b)^2 over R, G and B.
Plane difference_map(const ColourImage& picture, const ColourImage& reference, const Window& window);

}  // namespace pullfocus
