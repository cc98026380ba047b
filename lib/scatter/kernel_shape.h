// Which intensity distribution a circle of confusion has.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pullfocus {

// An aperture as a picture, rows top to bottom, seen as it shows in the picture when behind focus.
struct AperturePicture {
  int width = 0, height = 0;     // 1..4096 each
  std::vector<float> luminance;  // width * height linear values >= 0, finite, at least one > 0
};

struct KernelShape {
  enum class Kind { disc, polygon, gaussian, diffraction, image };
  Kind kind = Kind::disc;

  // Polygon only. At rotation 0 a corner points up, behind focus; rotation is anticlockwise as seen in the picture.
  int blades = 6;                 // 3..16
  double blade_rotation_deg = 0;  // finite
  double blade_roundness = 0;     // 0: straight blades .. 1: a disc

  std::shared_ptr<const AperturePicture> picture;  // image only, not null there

  // "disc", "polygon:N", "gaussian" or "diffraction". A picture cannot come from a text: whoever reads files resolves
  // "image:FILE". Throws Error(usage) naming --kernel.
  static KernelShape parse(std::string_view text);
};

// Throws Error(usage) that names --kernel, --blade-rotation or --blade-roundness.
void validate(const KernelShape& shape);

// "polygon:5, rotation 20, roundness 0.3": for reports.
std::string describe(const KernelShape& shape);

}  // namespace pullfocus
