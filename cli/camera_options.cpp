#include "camera_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "image/error.h"
#include "integers.h"
#include "key_file.h"

namespace pullfocus::cli {

FocusPixel FocusPixel::parse(const std::string& text) {
  FocusPixel pixel;
  if (read_integers(text, ",", {&pixel.x, &pixel.y})) return pixel;
  if (read_integers(text, ",@", {&pixel.x, &pixel.y, &pixel.frame.emplace()})) return pixel;
  throw Error(ErrorCode::usage,
              fmt::format("--focus-at '{}' is not X,Y or X,Y@FRAME in pixels, such as 960,540", text));
}

void add_camera_options(CLI::App& app, CameraArguments& a) {
  const char* group = "Camera";
  app.add_option("--focal-length", a.focal_length, "focal length in mm: VALUE, FRAME:VALUE,... or @FILE")->group(group);
  app.add_option("--fstop", a.fstop, "f-number: VALUE, FRAME:VALUE,... or @FILE")->group(group);
  app.add_option("--focus", a.focus,
                 "distance in focus, in scene units, may be inf: VALUE, FRAME:VALUE,... or @FILE (TOML keys)")
      ->group(group);
  app.add_option("--focus-at", a.focus_at, "X,Y[@FRAME]: focus on the depth of that pixel (of the shot's first frame)")
      ->group(group);
  app.add_option("--focus-interp", a.focus_interp, "between focus keys: dioptre (default), distance or smooth")
      ->group(group);
  app.add_option("--lens", a.lens, "render: as renderers' cameras do; paper: a real lens, which breathes")
      ->group(group)
      ->capture_default_str();
  app.add_option("--sensor-width", a.sensor_width, "sensor size in mm along --sensor-fit (default: header, else 36)")
      ->group(group);
  app.add_option("--sensor-fit", a.sensor_fit, "horizontal, vertical or auto")->group(group)->capture_default_str();
  app.add_option("--unit", a.unit, "metres per scene unit")->group(group)->capture_default_str();
  app.add_option("--near-scale", a.near_scale, "multiplier of the CoC in front of focus; 1: as the lens does, 0: sharp")
      ->group(group)
      ->capture_default_str();
  app.add_option("--far-scale", a.far_scale, "multiplier of the CoC behind focus")->group(group)->capture_default_str();
  app.add_option("--depth-kind", a.depth_kind, "planar: distance along the axis; coc: signed CoC diameter in pixels")
      ->group(group)
      ->capture_default_str();
}

namespace {

// A setting as typed, `@FILE` resolved. `member` picks the setting out of a key file.
std::optional<KeyedValue> setting(const std::optional<std::string>& text, const char* option, Infinity infinity,
                                  std::optional<KeyedValue> CameraKeys::*member, std::optional<FocusInterp>* interp) {
  if (!text) return std::nullopt;
  if (!text->starts_with('@')) return KeyedValue::parse(*text, option, infinity);
  const std::string path = text->substr(1);
  try {
    const CameraKeys keys = load_camera_keys(path);
    if (!(keys.*member)) throw Error(ErrorCode::usage, fmt::format("{} @{}: the file has no such keys", option, path));
    if (interp != nullptr) *interp = keys.interpolation;
    return keys.*member;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::unreadable) {
      throw Error(ErrorCode::usage, fmt::format("{} @{}: {}", option, path, error.what()));
    }
    throw;
  }
}

}  // namespace

Camera::Camera(const CameraArguments& a) : sensor_width_(a.sensor_width), unit_(a.unit) {
  depth_kind_ = parse_depth_kind(a.depth_kind);
  artistic_ = {static_cast<float>(a.near_scale), static_cast<float>(a.far_scale)};
  validate(artistic_);
  model_ = parse_lens_model(a.lens);
  fit_ = parse_sensor_fit(a.sensor_fit);
  if (!(unit_ > 0 && std::isfinite(unit_))) throw Error(ErrorCode::usage, "--unit must be greater than 0");
  if (sensor_width_ && !(*sensor_width_ > 0 && std::isfinite(*sensor_width_))) {
    throw Error(ErrorCode::usage, "--sensor-width must be greater than 0");
  }
  if (a.focus && a.focus_at)
    throw Error(ErrorCode::usage, "--focus and --focus-at exclude each other: give one of them");

  std::optional<FocusInterp> stored;
  focal_length_ = setting(a.focal_length, "--focal-length", Infinity::refused, &CameraKeys::focal_length, nullptr);
  fstop_ = setting(a.fstop, "--fstop", Infinity::refused, &CameraKeys::fstop, nullptr);
  focus_ = setting(a.focus, "--focus", Infinity::legal, &CameraKeys::focus, &stored);
  if (a.focus_at) focus_pixel_ = FocusPixel::parse(*a.focus_at);
  if (!a.focus_interp.empty()) {
    interpolation_ = parse_focus_interp(a.focus_interp);
  } else if (stored) {
    interpolation_ = *stored;
  }
}

CameraKeys Camera::keys() const {
  CameraKeys keys{interpolation_, focus_, fstop_, focal_length_};
  if (focus_from_pixel_) keys.focus = KeyedValue(*focus_from_pixel_, "--focus-at", Infinity::legal);
  return keys;
}

void Camera::set_keys(const CameraKeys& keys) {
  interpolation_ = keys.interpolation;
  focus_ = keys.focus;
  fstop_ = keys.fstop;
  focal_length_ = keys.focal_length;
  focus_from_pixel_.reset();
  focus_pixel_.reset();
}

CameraSource Camera::lens(int frame, const exr::FileInfo& file) const {
  CameraSource found;
  ThinLens& lens = found.lens;
  lens.model = model_;
  lens.fit = fit_;
  lens.metres_per_unit = unit_;
  const exr::CameraAttributes& header = file.camera;
  std::string missing;
  const auto lacks = [&](const char* option) { missing += (missing.empty() ? "" : ", ") + std::string(option); };

  if (focal_length_) {
    lens.focal_length_mm = focal_length_->linear_at(frame);
    found.focal_length = "--focal-length";
  } else if (header.focal_length_mm) {
    lens.focal_length_mm = static_cast<double>(*header.focal_length_mm);
    found.focal_length = "header";
  } else {
    lacks("--focal-length");
  }
  if (fstop_) {
    lens.f_number = fstop_->linear_at(frame);
    found.fstop = "--fstop";
  } else if (header.fstop) {
    lens.f_number = static_cast<double>(*header.fstop);
    found.fstop = "header";
  } else {
    lacks("--fstop");
  }
  if (focus_) {
    lens.focus_distance = focus_->focus_at(frame, interpolation_);
    found.focus = "--focus";
  } else if (focus_from_pixel_) {
    lens.focus_distance = *focus_from_pixel_;
    found.focus = "--focus-at";
  } else if (header.focus_distance_m) {
    lens.focus_distance = static_cast<double>(*header.focus_distance_m) / unit_;
    found.focus = "header";
  } else {
    lacks("--focus (or --focus-at)");
  }
  if (!missing.empty()) {
    throw Error(ErrorCode::usage,
                fmt::format("frame {} ({}): the camera is not complete: neither the file's header nor the command line "
                            "gives {}",
                            frame, file.path, missing));
  }

  const Raster raster = raster_of(file);
  const bool vertical = fit_ == SensorFit::vertical ||
                        (fit_ == SensorFit::automatic && raster.height > raster.width * raster.pixel_aspect);
  const auto& side = vertical ? header.sensor_height_mm : header.sensor_width_mm;
  found.sensor = sensor_width_ ? "--sensor-width" : side ? "header" : "default";
  if (sensor_width_) {
    lens.sensor_mm = *sensor_width_;
  } else if (side) {
    lens.sensor_mm = static_cast<double>(*side);
  }
  return found;
}

CocFunction Camera::coc(int frame, const exr::FileInfo& file) const {
  if (depth_kind_ == DepthKind::coc) return coc_function({}, raster_of(file), depth_kind_, artistic_);
  return coc_function(lens(frame, file).lens, raster_of(file), depth_kind_, artistic_);
}

std::string Camera::describe(int frame, const exr::FileInfo& file) const {
  const std::string artistic = fmt::format("near_scale={} far_scale={}", artistic_.in_front, artistic_.behind);
  if (depth_kind_ == DepthKind::coc) return "depth_kind=coc " + artistic;
  const ThinLens l = lens(frame, file).lens;
  return fmt::format(
      "depth_kind={} focal_length_mm={} fstop={} focus={} lens={} sensor_mm={} sensor_fit={} unit_m={} {}",
      name(depth_kind_), l.focal_length_mm, l.f_number, l.focus_distance, name(l.model), l.sensor_mm, name(l.fit),
      l.metres_per_unit, artistic);
}

Raster raster_of(const exr::FileInfo& file) {
  return {file.display_window.width(), file.display_window.height(), static_cast<double>(file.pixel_aspect)};
}

}  // namespace pullfocus::cli
