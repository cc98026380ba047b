#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "simple_shots.h"

namespace pullfocus::sequences::test {
namespace {

constexpr int width = 61, height = 37;

TEST(Depth, OfAFrontoParallelPlaneIsTheSameInAllCorners) {
  for (const float depth : {0.02f, 1.7f, 4000.0f}) {
    Shot shot = empty_shot();
    add_textured_wall(shot, depth, 1);
    Frame frame;
    ShotRenderer(shot, width, height).render(1, 1, frame);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) ASSERT_NEAR(frame.depth.at(x, y) / depth, 1, 1e-6) << x << ' ' << y;
  }
}

TEST(Depth, IsPlanarForATurnedAndMovedCamera) {
  Shot shot = empty_shot();
  add_rectangle(shot, 5, {0, 0}, {40, 40}, glm::vec3(1));
  Node& camera = shot.scene.nodes[0];
  camera.transform.rotation = glm::angleAxis(0.3f, glm::vec3(0, 1, 0));
  camera.transform.translation = {0.2f, -0.1f, 1};
  Frame frame;
  ShotRenderer(shot, width, height).render(1, 1, frame);
  // The plane z = -5 in the camera's space: 6 m before it along -z, and the ray per unit of planar depth is
  // (tan, ., -1) turned by 0.3, of which the part along -z is cos 0.3 + tan sin 0.3 (to the left).
  for (int x = 0; x < width; ++x) {
    const double tangent = (x + 0.5 - width / 2.0) * 36 / width / 50;
    const double expected = 6 / (std::cos(0.3) + tangent * std::sin(0.3));
    ASSERT_NEAR(static_cast<double>(frame.depth.at(x, 9)), expected, 1e-5 * expected) << x;
  }
}

TEST(Depth, IsNotMixedAtEdgesWhileColourIs) {
  Shot shot = empty_shot();
  add_rectangle(shot, 3, {0, 0}, {0.5f, 0.4f}, glm::vec3(1));
  Frame frame;
  ShotRenderer(shot, width, height).render(1, 64, frame);
  int mixed = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float z = frame.depth.at(x, y), red = frame.colour.get(x, y, 0);
      EXPECT_TRUE(z == sky_depth || std::abs(z - 3) < 1e-5f) << z;
      if (red > 0.05f && red < 0.95f) ++mixed;
    }
  EXPECT_GT(mixed, 20);
  EXPECT_TRUE(is_background(DepthKind::planar, sky_depth));
}

TEST(Deep, FirstSampleIsTheDepthOfThePicture) {
  const std::string file = std::string(PULLFOCUS_SOURCE_DIR) + "/sequences/shots/branches.toml";
  const ShotRenderer renderer(load_shot(file), width, height);
  Frame frame;
  DeepPixels deep;
  renderer.render(7, 1, frame);
  renderer.deep(7, deep);
  std::size_t most = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto& samples = deep.pixels[static_cast<std::size_t>(y * width + x)];
      ASSERT_FALSE(samples.empty());
      EXPECT_EQ(samples.front().depth, frame.depth.at(x, y));
      EXPECT_EQ(samples.back().depth, sky_depth);
      for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i].depth, samples[i - 1].depth);
      most = std::max(most, samples.size());
    }
  EXPECT_GT(most, 4u);
}

// With an odd size the middle pixel's ray hits the diagonal that the two triangles of a rectangle share.
TEST(Deep, SharedEdgesCountOnceAndHiddenSurfacesAreThere) {
  Shot shot = empty_shot();
  for (const float depth : {1.0f, 2.0f, 2.0001f}) add_rectangle(shot, depth, {0, 0}, {0.1f, 0.1f}, glm::vec3(depth));
  DeepPixels deep;
  ShotRenderer(shot, width, height).deep(1, deep);
  const auto& samples = deep.pixels[static_cast<std::size_t>(height / 2 * width + width / 2)];
  ASSERT_EQ(samples.size(), 4u);
  EXPECT_NEAR(samples[0].depth, 1, 1e-6);
  EXPECT_NEAR(samples[1].depth, 2, 1e-6);
  EXPECT_NEAR(samples[2].depth, 2.0001, 1e-6);
  EXPECT_NEAR(samples[1].colour.g, 2, 1e-6);
}

TEST(Picture, KeepsItsBitsWhereNothingMoves) {
  const std::string folder = std::string(PULLFOCUS_SOURCE_DIR) + "/sequences/shots/";
  const ShotRenderer renderer(load_shot(folder + "fearing-1.toml"), width, height);
  Frame a, b;
  renderer.render(10, 4, a);
  renderer.render(90, 4, b);
  int changed = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (a.depth.at(x, y) != b.depth.at(x, y) || a.colour.get(x, y, 1) != b.colour.get(x, y, 1)) ++changed;
  EXPECT_GT(changed, 20);
  EXPECT_LT(changed, width * height / 8);
  const ShotRenderer still(load_shot(folder + "fearing-3.toml"), width, height);
  still.render(10, 4, a);
  still.render(90, 4, b);
  EXPECT_TRUE(a.colour == b.colour);
}

// What is taken from earlier frames must be what would have been drawn, in whatever order frames come; frame 140 lies
// beyond the shot.
TEST(StillPixels, ChangeNoBits) {
  const std::string folder = std::string(PULLFOCUS_SOURCE_DIR) + "/sequences/shots/";
  for (const char* name : {"fearing-1", "fearing-3", "fearing-4", "lighting", "noise", "bokeh", "cut", "dolly"}) {
    const ShotRenderer renderer(load_shot(folder + name + ".toml"), width, height);
    StillPixels sharp, lens;
    for (const int frame : {1, 12, 13, 40, 140, 41, 70, -9, 71, 3, 100, 101, 2}) {
      Frame with, without;
      ColourImage truth_with, truth_without;
      renderer.render(frame, 5, with, &sharp);
      renderer.render(frame, 5, without);
      EXPECT_TRUE(with.colour == without.colour) << name << " frame " << frame;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) ASSERT_EQ(with.depth.at(x, y), without.depth.at(x, y)) << name << ' ' << frame;
      renderer.truth(frame, 17, truth_with, &lens);
      renderer.truth(frame, 17, truth_without);
      EXPECT_TRUE(truth_with == truth_without) << name << " frame " << frame;
    }
  }
}

TEST(StillPixels, SpareMostOfAPictureInWhichLittleMoves) {
  const std::string file = std::string(PULLFOCUS_SOURCE_DIR) + "/sequences/shots/fearing-1.toml";
  const ShotRenderer renderer(load_shot(file), width, height);
  StillPixels still;
  Frame frame;
  renderer.render(1, 1, frame, &still);
  EXPECT_GT(std::ranges::count_if(still.pixels, [](const auto& p) { return p.known && std::popcount(p.touched) < 8; }),
            width * height * 3 / 4);
}

TEST(Picture, NoiseIsNewInEveryFrameHasItsDeviationAndLeavesTheTruthAlone) {
  Shot shot = empty_shot();
  add_rectangle(shot, 2, {0, 0}, {9, 9}, glm::vec3(0.5f));
  const ShotRenderer clean(shot, width, height);
  shot.noise = 0.1;
  const ShotRenderer noisy(shot, width, height);
  Frame a, b, c;
  noisy.render(1, 1, a);
  noisy.render(2, 1, b);
  clean.render(1, 1, c);
  EXPECT_NEAR(rms_difference(a.colour, c.colour, 0), 0.05, 0.003);
  EXPECT_NEAR(rms_difference(a.colour, b.colour, 0), 0.05 * std::sqrt(2.0), 0.004);
  ColourImage with, without;
  noisy.truth(1, 4, with);
  clean.truth(1, 4, without);
  EXPECT_TRUE(with == without);
}

TEST(Shots, ThatComeWithTheProgramLoadAndShowSomething) {
  const std::string folder = std::string(PULLFOCUS_SOURCE_DIR) + "/sequences/shots";
  const auto names = shot_names(folder);
  EXPECT_GE(names.size(), 13u);
  for (const std::string& name : names) {
    const ShotRenderer renderer(load_shot(shot_path(folder, name)), 48, 27);
    EXPECT_FALSE(renderer.shot().description.empty()) << name;
    EXPECT_TRUE(renderer.lens(1).given) << name;
    for (const int frame : {renderer.shot().first_frame, renderer.shot().last_frame}) {
      Frame picture;
      renderer.render(frame, 1, picture);
      double sum = 0, surfaces = 0;
      for (int y = 0; y < 27; ++y)
        for (int x = 0; x < 48; ++x) {
          sum += std::min(1.0, static_cast<double>(picture.colour.get(x, y, 1)));
          surfaces += picture.depth.at(x, y) < sky_depth;
        }
      EXPECT_GT(sum / (48 * 27), 0.02) << name;
      EXPECT_GT(surfaces, 48 * 27 / 3) << name;
    }
  }
}

}  // namespace
}  // namespace pullfocus::sequences::test
