#include "camera/thin_lens.h"

#include <cmath>
#include <limits>

#include "camera/names.h"

namespace pullfocus {
namespace {

constexpr Named<LensModel> models[] = {{LensModel::render, "render"}, {LensModel::paper, "paper"}};
constexpr Named<SensorFit> fits[] = {
    {SensorFit::horizontal, "horizontal"}, {SensorFit::vertical, "vertical"}, {SensorFit::automatic, "auto"}};

constexpr double largest_float = std::numeric_limits<float>::max();

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::usage, message); }

void require_positive(double value, const char* option, const char* unit) {
  if (!(value > 0 && std::isfinite(value)))
    refuse(fmt::format("{} must be a positive number{}, not {}", option, unit, value));
}

double mm_per_unit(const ThinLens& lens) { return 1000 * lens.metres_per_unit; }

// Distance between lens and image plane (v), in millimetres: F P / (P - F) in the paper's model.
double image_distance_mm(const ThinLens& lens) {
  const double focal_mm = lens.focal_length_mm;
  const double focus_mm = lens.focus_distance * mm_per_unit(lens);
  if (lens.model == LensModel::render || std::isinf(focus_mm)) return focal_mm;
  return focal_mm * (focus_mm / (focus_mm - focal_mm));
}

bool fits_width(const ThinLens& lens, const Raster& raster) {
  if (lens.fit != SensorFit::automatic) return lens.fit == SensorFit::horizontal;
  return raster.width * raster.pixel_aspect >= raster.height;
}

// Rounds P before inverting it, as a depth sample is: at P exactly, the difference of inverses is then
// exactly 0.
float inverse_focus(double focus_distance) {
  if (focus_distance > largest_float) return 0;
  const float inverse = 1.0f / static_cast<float>(focus_distance);
  if (!std::isfinite(inverse)) refuse(fmt::format("--focus {} is too small", focus_distance));
  return inverse;
}

}  // namespace

std::string_view name(LensModel model) noexcept { return name_in(models, model); }
std::string_view name(SensorFit fit) noexcept { return name_in(fits, fit); }
LensModel parse_lens_model(std::string_view text) { return parse_name(models, text, "--lens"); }
SensorFit parse_sensor_fit(std::string_view text) { return parse_name(fits, text, "--sensor-fit"); }

void validate(const ThinLens& lens) {
  require_positive(lens.focal_length_mm, "--focal-length", " of millimetres");
  require_positive(lens.f_number, "--fstop", "");
  require_positive(lens.sensor_mm, "--sensor-width", " of millimetres");
  require_positive(lens.metres_per_unit, "--unit", " of metres per scene unit");
  if (!(lens.focus_distance > 0))
    refuse(fmt::format("--focus must be a positive distance or inf, not {}", lens.focus_distance));
  const double focus_mm = lens.focus_distance * mm_per_unit(lens);
  if (lens.model == LensModel::paper && !(focus_mm > lens.focal_length_mm))
    refuse(
        fmt::format("--focus: --lens paper needs a focus distance ({} mm) beyond the focal length ({} mm); "
                    "check --unit, or use --lens render",
                    focus_mm, lens.focal_length_mm));
}

double pixels_per_mm(const ThinLens& lens, const Raster& raster) {
  if (raster.width < 1 || raster.height < 1)
    refuse(fmt::format("the display window is {}x{} pixels: it must have at least one", raster.width, raster.height));
  if (!(raster.pixel_aspect > 0 && std::isfinite(raster.pixel_aspect)))
    refuse(fmt::format("the pixel aspect ratio must be a positive number, not {}", raster.pixel_aspect));
  if (fits_width(lens, raster)) return raster.width / lens.sensor_mm;
  return raster.height / lens.sensor_mm / raster.pixel_aspect;
}

void validate(const CocScale& scale) {
  const auto require = [](float value, const char* option) {
    if (!(value >= 0 && value <= std::numeric_limits<float>::max()))
      refuse(fmt::format("{} must be a finite number of at least 0, not {}", option, value));
  };
  require(scale.in_front, "--near-scale");
  require(scale.behind, "--far-scale");
}

CocFunction coc_function(const ThinLens& lens, const Raster& raster, DepthKind kind, const CocScale& artistic) {
  validate(artistic);
  if (kind == DepthKind::coc) return {kind, 1.0f, 0.0f, artistic};
  validate(lens);
  const double aperture_mm = lens.focal_length_mm / lens.f_number;
  const double scale = aperture_mm * image_distance_mm(lens) * pixels_per_mm(lens, raster) / mm_per_unit(lens);
  if (!(scale <= largest_float && scale >= std::numeric_limits<float>::min()))
    refuse(
        fmt::format("--focal-length {} mm, --fstop {}, --focus {}, --sensor-width {} mm and --unit {} together give "
                    "circles of confusion beyond all measure; one of them is wrong",
                    lens.focal_length_mm, lens.f_number, lens.focus_distance, lens.sensor_mm, lens.metres_per_unit));
  return {kind, static_cast<float>(scale), inverse_focus(lens.focus_distance), artistic};
}

}  // namespace pullfocus
