#include <gtest/gtest.h>

#include "camera/usage.h"
#include "filter/incremental_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::options_up_to;

const Window window{0, 0, 50, 30};

FilterOptions with_thresholds(double coc_px, double rgb) {
  FilterOptions options = options_up_to(12);
  options.thresholds = {coc_px, rgb};
  return options;
}

TEST(Thresholds, SmallChangesAreExemptAndSlowDriftsAreCaughtAgainstTheCommittedState) {
  IncrementalFilter filter(window, with_thresholds(0, 0.1));
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 4);
  filter.filter(frame, coc_as_depth);
  for (int step = 1; step <= 5; ++step) {
    frame.colour.set(20, 10, 1, 0.5f + 0.04f * static_cast<float>(step));
    EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, step == 3 ? 1 : 0) << step;
  }
}

TEST(Thresholds, AChangeBeyondOneOfThemTakesOverAllOfThePixel) {
  IncrementalFilter filter(window, with_thresholds(1, 0.1));
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 4);
  filter.filter(frame, coc_as_depth);
  frame.colour.set(20, 10, 0, 0.55f);
  frame.depth.at(20, 10) = 5;
  EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, 0);
  frame.depth.at(20, 10) = 5.5f;
  EXPECT_EQ(filter.filter(frame, coc_as_depth).updated, 1);
  EXPECT_EQ(filter.committed().colour.get(20, 10, 0), 0.55f);
}

TEST(Thresholds, AlphaCountsAsColour) {
  IncrementalFilter filter(window, with_thresholds(0, 0.1));
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 4);
  filter.filter(frame, coc_as_depth);
  frame.colour.set(3, 3, 3, 0.95f);
  EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, 0);
  frame.colour.set(3, 3, 3, 0.5f);
  EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, 1);
}

TEST(Thresholds, TheSignOfTheCocCounts) {
  IncrementalFilter filter(window, with_thresholds(3, 0));
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 2);
  filter.filter(frame, coc_as_depth);
  frame.depth.at(5, 5) = -2;
  EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, 1);
}

TEST(Thresholds, TheInvariantHoldsWithThem) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    test::RandomShot shot(window, seed, seed % 2 ? SampleType::half : SampleType::float32, true, true);
    FilterOptions options = with_thresholds(seed, 0.2 * seed);
    options.budget.amount = 60;
    IncrementalFilter filter(window, options);
    const KernelTable kernels(options.kernel);
    for (int frame = 0; frame < 8; ++frame) {
      if (frame > 0) shot.step();
      const Stats& stats = filter.filter(shot.frame(), test::random_lens(shot.random(), 12));
      ASSERT_EQ(stats.changed, stats.updated + stats.left_over);
      ASSERT_TRUE(test::invariant_holds(filter, kernels));
    }
  }
}

TEST(Thresholds, ThePictureNeverLeavesTheResultWindow) {
  IncrementalFilter filter(window, with_thresholds(0, 0.6));
  Frame frame = test::empty_frame(window, SampleType::float32, DepthKind::coc);
  for (int c = 0; c < 4; ++c) frame.colour.set(4, 4, c, 0.3f);
  filter.filter(frame, coc_as_depth);
  for (int c = 0; c < 4; ++c) frame.colour.set(4, 4, c, 0);
  EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, 0);
  EXPECT_TRUE(filter.result_window().contains(4, 4));
}

TEST(Thresholds, NegativeOnesAreRefusedByName) {
  expect_usage_error([] { validate(with_thresholds(-1, 0)); }, "--coc-threshold");
  expect_usage_error([] { validate(with_thresholds(0, INFINITY)); }, "--rgb-threshold");
}

}  // namespace
}  // namespace pullfocus
