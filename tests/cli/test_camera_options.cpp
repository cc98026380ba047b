#include "camera_options.h"

#include <gtest/gtest.h>

#include <cmath>

#include "usage.h"

namespace pullfocus::cli {
namespace {

exr::FileInfo file_with(std::optional<float> focus, std::optional<float> fstop, std::optional<float> focal_length) {
  exr::FileInfo file;
  file.path = "a.exr";
  file.display_window = {0, 0, 100, 200};
  file.camera.focus_distance_m = focus;
  file.camera.fstop = fstop;
  file.camera.focal_length_mm = focal_length;
  return file;
}

TEST(CameraOptions, HeaderFocusIsInMetresAndIsTurnedIntoSceneUnits) {
  CameraArguments arguments;
  arguments.unit = 0.01;
  const CameraSource found = Camera(arguments).lens(1, file_with(2.f, 4.f, 35.f));
  EXPECT_DOUBLE_EQ(found.lens.focus_distance, 200);
  EXPECT_EQ(found.focus, "header");
}

TEST(CameraOptions, KeysMoveOverFrames) {
  CameraArguments arguments;
  arguments.focus = "1:1,5:inf";
  arguments.fstop = "1:2,3:4";
  const Camera camera(arguments);
  const auto file = file_with({}, {}, 50.f);
  EXPECT_DOUBLE_EQ(camera.lens(3, file).lens.focus_distance, 2);
  EXPECT_DOUBLE_EQ(camera.lens(2, file).lens.f_number, 3);
  EXPECT_TRUE(std::isinf(camera.lens(9, file).lens.focus_distance));
}

TEST(CameraOptions, TheSensorComesFromTheOptionThenTheHeaderThenIs36mm) {
  CameraArguments arguments;
  auto file = file_with(1.f, 2.f, 50.f);
  EXPECT_EQ(Camera(arguments).lens(1, file).lens.sensor_mm, 36);
  file.camera.sensor_width_mm = 24.f;
  file.camera.sensor_height_mm = 48.f;
  EXPECT_EQ(Camera(arguments).lens(1, file).lens.sensor_mm, 24);
  arguments.sensor_fit = "auto";  // the picture is taller than wide
  EXPECT_EQ(Camera(arguments).lens(1, file).lens.sensor_mm, 48);
  arguments.sensor_width = 10;
  EXPECT_EQ(Camera(arguments).lens(1, file).lens.sensor_mm, 10);
}

TEST(CameraOptions, ACocImageNeedsNoLens) {
  CameraArguments arguments;
  arguments.depth_kind = "coc";
  EXPECT_EQ(Camera(arguments).coc(1, file_with({}, {}, {}))(-3.5f), -3.5f);
}

TEST(CameraOptions, FocusPixelsAreParsed) {
  EXPECT_EQ(FocusPixel::parse("3,-4").y, -4);
  EXPECT_FALSE(FocusPixel::parse("3,4").frame);
  EXPECT_EQ(FocusPixel::parse("3,4@12").frame, 12);
  for (const char* text : {"", "3", "3,", "3,4@", "3,4,5", "a,b", "3,4@x", "4294967296,5", "3,4@99999999999"}) {
    expect_usage_error([&] { FocusPixel::parse(text); }, "--focus-at");
  }
}

}  // namespace
}  // namespace pullfocus::cli
