#include <gtest/gtest.h>

#include <limits>

#include "camera/thin_lens.h"
#include "usage.h"

namespace pullfocus {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

TEST(LensOptions, WrongNumbersAreRefusedByTheNameOfTheirOption) {
  const auto refused = [](double ThinLens::*field, double value, const char* option) {
    ThinLens lens{50, 2, 1};
    lens.*field = value;
    expect_usage_error([&] { validate(lens); }, option);
  };
  for (double value : {0.0, -1.0, nan_value}) {
    refused(&ThinLens::focal_length_mm, value, "--focal-length");
    refused(&ThinLens::f_number, value, "--fstop");
    refused(&ThinLens::focus_distance, value, "--focus");
    refused(&ThinLens::sensor_mm, value, "--sensor-width");
    refused(&ThinLens::metres_per_unit, value, "--unit");
  }
  for (auto [field, option] : {std::pair{&ThinLens::focal_length_mm, "--focal-length"},
                               {&ThinLens::f_number, "--fstop"},
                               {&ThinLens::sensor_mm, "--sensor-width"},
                               {&ThinLens::metres_per_unit, "--unit"}})
    refused(field, inf, option);
}

TEST(LensOptions, InfiniteFocusIsAccepted) { EXPECT_NO_THROW(validate({50, 2, inf})); }

TEST(LensOptions, PaperModelRefusesFocusUpToTheFocalLength) {
  ThinLens lens{8, 3.5, 0.008};
  EXPECT_NO_THROW(validate(lens));
  lens.model = LensModel::paper;
  for (double focus : {0.004, 0.008}) {
    lens.focus_distance = focus;
    expect_usage_error([&] { validate(lens); }, "--focus");
  }
  lens.focus_distance = 0.0081;
  EXPECT_NO_THROW(validate(lens));
}

TEST(LensOptions, ResultsThatNoFloatHoldsAreRefused) {
  const auto refused = [](const ThinLens& lens, const char* option) {
    expect_usage_error([&] { coc_function(lens, {1920, 1080}, DepthKind::planar); }, option);
  };
  refused({1e30, 2, 1}, "--focal-length");
  refused({50, 1e300, 1}, "--fstop");
  refused({50, 2, 1e-44}, "--focus");
}

TEST(LensOptions, EmptyWindowAndImpossiblePixelsAreRefused) {
  const ThinLens lens{50, 2, 1};
  expect_usage_error([&] { pixels_per_mm(lens, {0, 1080}); }, "display window is 0x1080");
  for (double aspect : {0.0, -1.0, inf, nan_value})
    expect_usage_error([&] { pixels_per_mm(lens, {1920, 1080, aspect}); }, "pixel aspect");
}

TEST(LensOptions, NamesParseBack) {
  for (LensModel model : {LensModel::render, LensModel::paper}) EXPECT_EQ(parse_lens_model(name(model)), model);
  for (SensorFit fit : {SensorFit::horizontal, SensorFit::vertical, SensorFit::automatic})
    EXPECT_EQ(parse_sensor_fit(name(fit)), fit);
  expect_usage_error([] { parse_lens_model("thick"); }, "--lens: 'thick' is not one of render, paper");
  expect_usage_error([] { parse_sensor_fit(""); }, "--sensor-fit");
}

}  // namespace
}  // namespace pullfocus
