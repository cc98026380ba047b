// Thin lens: from depth to the diameter of the circle of confusion (CoC).
//
// Potmesil and Chakravarty 1981, in the form of P. Fearing, "Importance Ordering for Real-Time Depth of
// Field", 1996:
//
//   C = |Vu - Vp| F / (n Vu)      Vu = F U / (U - F)      Vp = F P / (P - F) (eqs 1-3)
//
// Since 1/Vu = 1/F - 1/U, this is (F/n) Vp |1/P - 1/U|: linear in inverse depth, without a pole at U = F.
// Signed, with v for the distance between lens and image plane:
//
//   c(U) = (F/n) v (1/P - 1/U)    > 0 behind focus, < 0 in front
#pragma once

#include <string_view>

#include "camera/depth.h"

namespace pullfocus {

enum class LensModel {
  render,  // v = F: a rendered pinhole image keeps its field of view at every focus, as renderers' own lenses
           // do
  paper    // v = 1 / (1/F - 1/P): a real lens, which breathes; needs P > F
};

// Which side of the displayed picture the sensor size is the length of.
enum class SensorFit { horizontal, vertical, automatic };  // automatic: the longer side as displayed

std::string_view name(LensModel model) noexcept;    // as --lens spells it
std::string_view name(SensorFit fit) noexcept;      // as --sensor-fit spells it
LensModel parse_lens_model(std::string_view text);  // these throw Error(usage) naming their option
SensorFit parse_sensor_fit(std::string_view text);

// The display window, which is what the lens images on the sensor. Sizes in pixels, >= 1.
struct Raster {
  int width = 0, height = 0;
  double pixel_aspect = 1;  // pixel width / pixel height, > 0
};

struct ThinLens {
  double focal_length_mm = 0;  // F, > 0
  double f_number = 0;         // n, > 0
  double focus_distance = 0;   // P in scene units, > 0, may be infinite
  LensModel model = LensModel::render;
  double sensor_mm = 36;  // length of the side that `fit` names, > 0
  SensorFit fit = SensorFit::horizontal;
  double metres_per_unit = 1;  // scene unit, > 0
};

// Throws Error(usage) that names the option to correct.
void validate(const ThinLens& lens);

// Pixels per millimetre of sensor along a row: CoC diameters are measured horizontally.
double pixels_per_mm(const ThinLens& lens, const Raster& raster);

// Artistic multipliers of the diameter, finite and >= 0. 1 leaves every bit of it, 0 makes that side sharp.
struct CocScale {
  float in_front = 1, behind = 1;  // of focus
  bool operator==(const CocScale&) const = default;
};

// Throws Error(usage) naming --near-scale or --far-scale.
void validate(const CocScale& scale);

// Signed CoC diameter in pixels of a depth. Plain IEEE float operations, so that every target gives the same
// bits. The caller sorts out background first; depth +inf gives the diameter at infinity.
struct CocFunction {
  DepthKind kind = DepthKind::planar;
  float scale = 0;          // pixels times scene units, finite and > 0 (planar)
  float inverse_focus = 0;  // 1/P in 1 / scene units, finite; 0 for focus at infinity
  CocScale artistic{};      // of either kind of depth
  bool operator==(const CocFunction&) const = default;

  float operator()(float depth) const noexcept {
    return scaled(kind == DepthKind::coc ? depth : scale * (inverse_focus - 1.0f / depth));
  }
  // Diameter of a background pixel (see is_background).
  float background() const noexcept { return kind == DepthKind::coc ? 0.0f : scaled(scale * inverse_focus); }

 private:
  // A factor of 0 gives 0 even for the infinite diameter of a tiny depth.
  float scaled(float c) const noexcept {
    const float factor = c < 0 ? artistic.in_front : artistic.behind;
    return factor == 0 ? 0.0f : c * factor;
  }
};

// Throws Error(usage) as validate() does, and where no float holds the result. A depth equal to the float
// nearest P has diameter exactly 0. For DepthKind::coc neither lens nor raster is looked at.
CocFunction coc_function(const ThinLens& lens, const Raster& raster, DepthKind kind, const CocScale& artistic = {});

}  // namespace pullfocus
