// The aperture as a picture: its luminance is the intensity distribution.
//
// The picture's longer side spans the CoC's diameter and its centre lies on the source. Weight of a pixel = mean
// luminance over its area (exact, from a summed-area table; Crow 1984), in at most 16 levels evenly spaced up to the
// brightest pixel: none is off by more than 1/32 of that, or, if it is fainter than 1/32, by all it has. Below 2 px the
// kernel is mixed with the identity (density.h). Footprint: a box as wide as the CoC. Cost: an edge wherever the level
// changes along a row: a plain shape costs as much as the disc; with noise it may be every pixel of the box.
#pragma once

#include <cstdint>
#include <vector>

#include "scatter/kernel.h"
#include "scatter/kernel_shape.h"

namespace pullfocus {

class ApertureImage {
 public:
  explicit ApertureImage(const AperturePicture& picture);  // validated

  // Upright, as it shows behind focus. diameter_px in [0, 500], horizontal; pixel_aspect = pixel width / height (the
  // picture's own pixels are square).
  Kernel kernel(double diameter_px, double pixel_aspect) const;

 private:
  double integral(double x, double y) const noexcept;  // luminance over [0, x) x [0, y), in picture pixels

  int width_, height_;
  std::vector<std::int64_t> sums_;  // (width + 1) * (height + 1), of luminance in 2^-16 of the brightest
};

}  // namespace pullfocus
