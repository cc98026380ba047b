// The camera as the command line and the files' headers give it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/keys.h"
#include "camera/thin_lens.h"
#include "exr/file_info.h"
#include "key_file.h"

namespace CLI {
class App;
}

namespace pullfocus::cli {

// A pixel whose depth is the focus distance; without `frame`, that of the shot's first frame on disk.
struct FocusPixel {
  int x = 0, y = 0;
  std::optional<int> frame;

  static FocusPixel parse(const std::string& text);  // "X,Y" or "X,Y@FRAME"; throws Error(usage)
};

// Options as typed.
struct CameraArguments {
  std::optional<std::string> focal_length, fstop, focus, focus_at;
  std::optional<double> sensor_width;
  std::string focus_interp = "", lens = "render", sensor_fit = "horizontal", depth_kind = "planar";
  double unit = 1, near_scale = 1, far_scale = 1;
};
void add_camera_options(CLI::App& app, CameraArguments& arguments);

// Where a lens setting of a frame came from, for reports.
struct CameraSource {
  ThinLens lens;
  std::string focal_length, fstop, focus, sensor;  // "--fstop", "header", "default", ...
};

class Camera {
 public:
  explicit Camera(const CameraArguments& arguments);  // throws Error(usage)

  DepthKind depth_kind() const noexcept { return depth_kind_; }
  const std::optional<FocusPixel>& focus_pixel() const noexcept { return focus_pixel_; }
  void set_focus(double distance) noexcept { focus_from_pixel_ = distance; }  // for focus_pixel()

  // What options say of these settings, --focus-at included; and another choice in its place.
  CameraKeys keys() const;
  void set_keys(const CameraKeys& keys);

  // Lens of one frame: options first, then the header. Throws Error(usage) that lists every setting found in
  // neither.
  CameraSource lens(int frame, const exr::FileInfo& file) const;

  // The whole way to CoC diameters. A CoC image needs no lens.
  CocFunction coc(int frame, const exr::FileInfo& file) const;

  // Settings of a frame in one line, for the output's header.
  std::string describe(int frame, const exr::FileInfo& file) const;

 private:
  std::optional<KeyedValue> focal_length_, fstop_, focus_;
  std::optional<FocusPixel> focus_pixel_;
  std::optional<double> focus_from_pixel_;
  std::optional<double> sensor_width_;
  FocusInterp interpolation_ = FocusInterp::dioptre;
  LensModel model_ = LensModel::render;
  SensorFit fit_ = SensorFit::horizontal;
  DepthKind depth_kind_ = DepthKind::planar;
  double unit_ = 1;
  CocScale artistic_;
};

Raster raster_of(const exr::FileInfo& file);

}  // namespace pullfocus::cli
