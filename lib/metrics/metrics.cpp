#include "metrics/metrics.h"

namespace pullfocus {

PictureErrors picture_errors(const ColourImage& picture, const ColourImage& reference, const Window& window,
                             double peak) {
  PictureErrors errors{differences(picture, reference, window, peak), 1, 0};
  if (errors.differences.largest == 0) return errors;  // what the others give then, for nothing
  errors.ssim = ssim(picture, reference, window);
  errors.flip = flip(picture, reference, window);
  return errors;
}

}  // namespace pullfocus
