#include "camera/thin_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace pullfocus {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double float_epsilon = std::numeric_limits<float>::epsilon();

ThinLens paper_lens(double focus_mm) {
  ThinLens lens{8, 3.5, focus_mm};
  lens.model = LensModel::paper;
  lens.sensor_mm = 16.0 / 7;
  lens.metres_per_unit = 0.001;
  return lens;
}

// Fearing's eqs 1-3 as printed, in millimetres, signed by side; U > F and P > F.
long double fearing_coc_mm(long double f, long double n, long double p, long double u) {
  const long double v_u = f * u / (u - f);
  const long double v_p = f * p / (p - f);
  const long double diameter = std::abs(v_u - v_p) * f / (n * v_u);
  return u < p ? -diameter : diameter;
}

double log_uniform(std::mt19937& random, double low, double high) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
}

TEST(ThinLens, PaperModelAgreesWithFearingEquations1To3) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    ThinLens lens = paper_lens(0);
    lens.focal_length_mm = log_uniform(random, 2, 300);
    lens.f_number = log_uniform(random, 0.7, 32);
    lens.focus_distance = static_cast<float>(lens.focal_length_mm * log_uniform(random, 1.01, 1000));
    const float depth = static_cast<float>(lens.focal_length_mm * log_uniform(random, 1.01, 1000));
    const CocFunction coc = coc_function(lens, {1920, 1080}, DepthKind::planar);
    const long double expected =
        fearing_coc_mm(lens.focal_length_mm, lens.f_number, lens.focus_distance, depth) * 1920 / lens.sensor_mm;
    // Rounding of either inverse, of their difference, of scale and of the product.
    const double tolerance = 3 * float_epsilon * coc.scale * (1 / lens.focus_distance + 1.0 / depth);
    EXPECT_NEAR(coc(depth), static_cast<double>(expected), tolerance)
        << "F " << lens.focal_length_mm << " n " << lens.f_number << " P " << lens.focus_distance << " U " << depth;
  }
}

TEST(ThinLens, RenderModelEqualsCyclesFormula) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    ThinLens lens{log_uniform(random, 10, 200), log_uniform(random, 1, 22), log_uniform(random, 0.1, 100)};
    const double z = log_uniform(random, 0.1, 1000);
    const CocFunction coc = coc_function(lens, {1280, 720}, DepthKind::planar);
    const double lens_m = lens.focal_length_mm / 1000;
    const double radius_px = lens_m / (2 * lens.f_number) * lens_m * std::abs(1 / lens.focus_distance - 1 / z) * 1280 /
                             (lens.sensor_mm / 1000);
    const double tolerance = 3 * float_epsilon * coc.scale * (1 / lens.focus_distance + 1 / z);
    EXPECT_NEAR(std::abs(coc(static_cast<float>(z))), 2 * radius_px, tolerance);
  }
}

TEST(ThinLens, DiameterIsPositiveBehindFocusAndNegativeInFront) {
  const CocFunction coc = coc_function(paper_lens(40), {256, 256}, DepthKind::planar);
  EXPECT_GT(coc(41), 0);
  EXPECT_LT(coc(39), 0);
  EXPECT_FLOAT_EQ(coc(20), -64);  // (8 / 3.5) 10 (1/40 - 1/20) mm on a film of 16/7 mm for 256 px
}

TEST(ThinLens, DepthAtFocusHasDiameterExactlyZero) {
  std::mt19937 random(3);
  for (int i = 0; i < 10000; ++i) {
    const ThinLens lens{50, 2, log_uniform(random, 0.01, 1000)};
    const CocFunction coc = coc_function(lens, {1920, 1080}, DepthKind::planar);
    EXPECT_EQ(coc(static_cast<float>(lens.focus_distance)), 0.0f);
  }
}

TEST(ThinLens, InfiniteDepthIsTheLimitOfGreatDepths) {
  for (LensModel model : {LensModel::render, LensModel::paper}) {
    ThinLens lens = paper_lens(40);
    lens.model = model;
    const CocFunction coc = coc_function(lens, {256, 256}, DepthKind::planar);
    EXPECT_FLOAT_EQ(coc(1.0e12f), coc.background());
    EXPECT_EQ(coc(std::numeric_limits<float>::infinity()), coc.background());
  }
}

TEST(ThinLens, InfiniteFocusSharpensInfinityAndModelsAgreeThere) {
  ThinLens lens{50, 2, inf};
  const CocFunction render = coc_function(lens, {1920, 1080}, DepthKind::planar);
  lens.model = LensModel::paper;
  const CocFunction paper = coc_function(lens, {1920, 1080}, DepthKind::planar);
  EXPECT_EQ(render.background(), 0.0f);
  EXPECT_LT(render(1), 0);
  EXPECT_EQ(render.scale, paper.scale);
}

TEST(ThinLens, SweepThroughFocalLengthIsFiniteAndContinuous) {
  const CocFunction coc = coc_function(paper_lens(40), {256, 256}, DepthKind::planar);
  float before = coc(4);
  for (float depth = 4; depth < 16; depth += 0.001f) {
    const float now = coc(depth);
    ASSERT_TRUE(std::isfinite(now));
    ASSERT_GE(now, before);
    ASSERT_LT(now - before, coc.scale * 0.0011f / (depth * depth) + 1e-3f) << depth;
    before = now;
  }
}

TEST(ThinLens, FocusJustBeyondFocalLengthIsFinite) {
  for (double margin : {1e-3, 1e-6, 1e-9}) {
    const CocFunction coc = coc_function(paper_lens(8 * (1 + margin)), {256, 256}, DepthKind::planar);
    EXPECT_NEAR(coc.scale, 8 / 3.5 * 8 * 256 / (16.0 / 7) / margin, 0.01 * coc.scale);
    EXPECT_TRUE(std::isfinite(coc.background()));
  }
}

TEST(ThinLens, SceneUnitScalesDistancesOnly) {
  const CocFunction mm = coc_function(paper_lens(40), {256, 256}, DepthKind::planar);
  ThinLens lens = paper_lens(0.040);
  lens.metres_per_unit = 1;
  const CocFunction metres = coc_function(lens, {256, 256}, DepthKind::planar);
  for (float depth_mm : {20.0f, 35.0f, 90.0f, 1000.0f})
    EXPECT_NEAR(mm(depth_mm), metres(depth_mm / 1000), 1e-4) << depth_mm;
}

TEST(ThinLens, SensorFitMeasuresTheSideItNames) {
  ThinLens lens{50, 2, 1};
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1920, 1080}), 1920 / 36.0);
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1920, 1080, 2}), 1920 / 36.0);
  lens.fit = SensorFit::vertical;
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1920, 1080}), 1080 / 36.0);
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1920, 1080, 2}),
                   1080 / 36.0 / 2);  // wide pixels: fewer per millimetre
  lens.fit = SensorFit::automatic;
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1920, 1080}), 1920 / 36.0);
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1080, 1920}), 1920 / 36.0);
  EXPECT_DOUBLE_EQ(pixels_per_mm(lens, {1080, 1920, 2}), 1080 / 36.0);  // displayed 2160 wide
}

TEST(ThinLens, CocKindPassesDiametersThroughAndNeedsNoLens) {
  const CocFunction coc = coc_function({}, {}, DepthKind::coc);
  for (float diameter : {-30.5f, 0.0f, 12.25f}) EXPECT_EQ(coc(diameter), diameter);
  EXPECT_EQ(coc.background(), 0.0f);
}

TEST(ThinLens, AgreesWithValuesStoredBesideCyclesRenders) {
  const auto folder = std::filesystem::path(PULLFOCUS_SOURCE_DIR) / "../shared/data/cycles";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no Cycles renders in " << folder;
  const auto number = [](const std::string& text, const std::string& key) {
    const std::string label = "\"" + key + "\": ";
    return std::stod(text.substr(text.find(label) + label.size()));
  };
  for (const char* sequence : {"static_pull", "mover", "hd1080"}) {
    std::ifstream in(folder / sequence / "camera.json");
    const std::string json{std::istreambuf_iterator<char>(in), {}};
    ThinLens lens{number(json, "focal_length_mm"), number(json, "f_stop"), number(json, "focus_distance_m")};
    lens.sensor_mm = number(json, "sensor_width_mm");
    lens.metres_per_unit = number(json, "scene_unit_m");
    const Raster raster{static_cast<int>(number(json, "width")), static_cast<int>(number(json, "height"))};
    const CocFunction coc = coc_function(lens, raster, DepthKind::planar);
    EXPECT_FLOAT_EQ(coc.scale, static_cast<float>(2 * number(json, "coc_px_times_m"))) << sequence;
    EXPECT_FLOAT_EQ(coc.background(), static_cast<float>(2 * number(json, "coc_radius_px_at_infinity"))) << sequence;
  }
}

}  // namespace
}  // namespace pullfocus
