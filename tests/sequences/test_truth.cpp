#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "filter/filter.h"
#include "simple_shots.h"

namespace pullfocus::sequences::test {
namespace {

constexpr int width = 96, height = 64;

ColourImage linear_filter(const ShotRenderer& renderer, const Frame& frame) {
  FilterOptions options;
  const auto filter = make_linear_filter(frame.window(), options);
  filter->filter(frame, coc_function(renderer.lens(1).lens, {width, height}, DepthKind::planar));
  return filter->result();
}

// f-numbers chosen for diameters of whole pixels, which the filter's table holds.
TEST(Truth, OfAFrontoParallelPlaneConvergesToTheDiscBlurOfTheLinearFilter) {
  for (const auto& [depth, focus] : {std::pair{4.0f, 2.0}, std::pair{1.5f, 3.0}, std::pair{3.0f, 1.0}}) {
    Shot shot = empty_shot();
    add_textured_wall(shot, depth, 5);
    set_lens(shot, 50, 1, focus);
    const double at_f1 = coc_diameter(ShotRenderer(shot, width, height), width, height, depth);
    set_lens(shot, 50, std::abs(at_f1) / 12, focus);
    const ShotRenderer renderer(shot, width, height);
    ASSERT_NEAR(std::abs(coc_diameter(renderer, width, height, depth)), 12, 1e-4);
    Frame frame;
    renderer.render(1, 256, frame);
    const ColourImage blurred = linear_filter(renderer, frame);
    ColourImage coarse, fine;
    renderer.truth(1, 64, coarse);
    renderer.truth(1, 1024, fine);
    const double sharp = rms_difference(frame.colour, fine, 14), error = rms_difference(blurred, fine, 14);
    EXPECT_LT(error, 0.004) << "depth " << depth;
    EXPECT_LT(error, sharp / 20) << "the plane is out of focus";
    EXPECT_LT(error, rms_difference(blurred, coarse, 14) / 2) << "it converges";
  }
}

struct Setting {
  float depth;
  double focus, f_number;
};

// The radius of a uniform disc is sqrt(2 <r^2>). Of <r^2>, the square that stands for the light has s^2/6, pixels 1/6.
double measured_radius(const ShotRenderer& renderer, double side_px) {
  ColourImage image;
  renderer.truth(1, 1024, image);
  double sum = 0, sx = 0, sy = 0, square = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double value = static_cast<double>(image.get(x, y, 0));
      sum += value;
      sx += value * x;
      sy += value * y;
      square += value * (static_cast<double>(x) * x + static_cast<double>(y) * y);
    }
  const double spread = square / sum - (sx * sx + sy * sy) / (sum * sum);
  return std::sqrt(2 * (spread - side_px * side_px / 6 - 1.0 / 6));
}

TEST(Truth, RadiusOfAPointLightAgreesWithTheFormulaNearAndFar) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const LensModel model : {LensModel::render, LensModel::paper})
    for (const auto& [depth, focus, f_number] :
         {Setting{8, 1, 1.2}, Setting{1, 4, 1.2}, Setting{0.8f, infinite, 3}, Setting{30, 0.6, 4}}) {
      Shot shot = empty_shot();
      const double side_px = 2;
      set_lens(shot, 135, f_number, focus);
      shot.lens.model = model;
      const double image_mm = image_distance_mm(ShotRenderer(shot, width, height).lens(1).lens);
      const auto side = static_cast<float>(side_px * 36 / width / image_mm * static_cast<double>(depth));
      add_rectangle(shot, depth, {0, 0}, {side, side}, glm::vec3(1000));
      const ShotRenderer renderer(shot, width, height);
      const double formula = std::abs(coc_diameter(renderer, width, height, depth)) / 2;
      ASSERT_GT(formula, 8);
      ASSERT_LT(formula, 30);
      EXPECT_NEAR(measured_radius(renderer, side_px) / formula, 1, 0.01) << name(model) << " depth " << depth;
    }
}

TEST(Truth, TwiceTheSamplesAtLeastHalveTheVariance) {
  Shot shot = empty_shot();
  add_textured_wall(shot, 5, 8);
  add_rectangle(shot, 1.2f, {0.1f, 0}, {0.3f, 0.2f}, {2, 1, 0.5f});
  const ShotRenderer renderer(shot, width, height);
  ColourImage exact, image;
  renderer.truth(1, 8192, exact);
  double first = 0, last = 0;
  for (const int samples : {8, 16, 32, 64, 128}) {
    renderer.truth(1, samples, image);
    const double variance = std::pow(rms_difference(image, exact, 0), 2);
    if (last > 0) {
      EXPECT_LT(variance, 0.5 * last) << samples;
    }
    if (first == 0) first = variance;
    last = variance;
  }
  EXPECT_LT(last, first / 16 / 1.5) << "better than independent samples";
}

TEST(Truth, OfASceneInFocusEqualsThePinholePicture) {
  Shot shot = empty_shot();
  add_textured_wall(shot, 2, 3);
  const ShotRenderer renderer(shot, width, height);
  Frame frame;
  renderer.render(1, 1024, frame);
  ColourImage image;
  renderer.truth(1, 1024, image);
  EXPECT_LT(rms_difference(frame.colour, image, 0), 0.002);
}

TEST(Truth, OfViewsEqualsThatOfRays) {
  Shot shot = empty_shot();
  add_textured_wall(shot, 5, 4);
  add_rectangle(shot, 1.5f, {0, 0}, {0.2f, 0.2f}, glm::vec3(0.5f));
  const ShotRenderer renderer(shot, width, height);
  ColourImage rays, views;
  renderer.truth(1, 2048, rays);
  renderer.truth_of_views(1, 2048, views);
  EXPECT_LT(rms_difference(rays, views, 0), 0.004);
}

bool same_bits(const Plane& a, const Plane& b) {
  return a.window() == b.window() && std::memcmp(a.row(0), b.row(0), a.window().pixels() * sizeof(float)) == 0;
}

TEST(Truth, AndPicturesAreTheSameBitsForAnyNumberOfThreads) {
  const std::string file = std::string(PULLFOCUS_SOURCE_DIR) + "/sequences/shots/fearing-2.toml";
  const auto all = [&](int threads, Frame& frame, ColourImage& truth) {
    tbb::task_arena(threads).execute([&] {
      const ShotRenderer renderer(load_shot(file), width, height);
      renderer.render(40, 4, frame);
      renderer.truth(40, 9, truth);
    });
  };
  Frame one, four;
  ColourImage truth_of_one, truth_of_four;
  all(1, one, truth_of_one);
  all(4, four, truth_of_four);
  EXPECT_TRUE(one.colour == four.colour);
  EXPECT_TRUE(same_bits(one.depth, four.depth));
  EXPECT_TRUE(truth_of_one == truth_of_four);
}

}  // namespace
}  // namespace pullfocus::sequences::test
