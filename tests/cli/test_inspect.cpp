#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program.h"

namespace pullfocus::test {
namespace {

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in:\n" << text;
}

TEST(Inspect, TellsWhatWasFoundAndWhatItWasTakenFor) {
  const TempFolder folder;
  write_shot(folder, 1, 3);
  const Outcome outcome = run(fmt::format("inspect '{}' --fstop 4", folder / "shot.####.exr"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_words(outcome.out, {"frames 1-3 (3)", "24x18", "R G B A (half", "Z (float), taken as planar", "--depth-kind",
                             "50 mm (header)", "f/4 (--fstop)", "focus 2 (header)", "surfaces from 2 to 7.6",
                             "bytes a pixel", "% of pixels change", "not accumulated"});
}

TEST(Inspect, ExplainsOnePixel) {
  const TempFolder folder;
  write_shot(folder, 1, 1);
  const std::string command = fmt::format("inspect '{}' --explain ", folder / "shot.####.exr");
  const Outcome outcome = run(command + "5,8");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_words(outcome.out,
               {"5,8: depth 2;", "CoC 0.000 px", "layer -2 to 2 px: weight", "pixels cover it", "from 5,8"});
  EXPECT_EQ(run(command + "500,8").code, 2);
}

TEST(Inspect, SaysThatNoSurfaceWasFound) {
  const TempFolder folder;
  TestImage image({0, 0, 8, 8}, {0, 0, 8, 8});
  for (const char* name : {"R", "G", "B"}) image.add_constant(name, Imf::HALF, 1);
  image.add_constant("Z", Imf::FLOAT, 1e10f);
  exr::test::write_scanlines(folder / "sky.0001.exr", image);
  const Outcome outcome =
      run(fmt::format("inspect '{}' --fstop 4 --focal-length 50 --focus 1", folder / "sky.0001.exr"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_words(outcome.out, {"no surface anywhere"});
}

// Half colour 8 bytes, float depth 4, the depth channel as it is passed on 4; the filter's result 8.
TEST(Inspect, CountsTheFramesInFlight) {
  const TempFolder folder;
  write_shot(folder, 1, 1);
  const std::string command = fmt::format("inspect '{}' ", folder / "shot.####.exr");
  expect_words(run(command + "--threads 1").out, {"+ 24 bytes a pixel (filter + frames, 1 in flight)"});
  expect_words(run(command + "--threads 4").out, {"+ 72 bytes a pixel (filter + frames, 4 in flight)"});
  expect_words(run(command + "--threads 4 --mask A").out, {"+ 88 bytes a pixel (filter + frames, 4 in flight)"});
  expect_words(run(command + "--threads 4 --output-type float").out, {"+ 112 bytes a pixel"});
}

TEST(Inspect, ReportsGapsByTheirNumbers) {
  const TempFolder folder;
  write_shot(folder, 1, 2);
  write_shot(folder, 6, 6);
  const Outcome outcome = run(fmt::format("inspect '{}'", folder / "shot.####.exr"));
  ASSERT_EQ(outcome.code, 0);
  expect_words(outcome.err, {"frames 3-5 are missing"});
}

}  // namespace
}  // namespace pullfocus::test
