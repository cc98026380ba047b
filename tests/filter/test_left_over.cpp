// What a call says of the work it left over.
#include <gtest/gtest.h>

#include <cmath>

#include "filter/incremental_filter.h"
#include "filter/linear_filter.h"
#include "image/error.h"
#include "plain_frames.h"
#include "random_frames.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::options_up_to;

const Window window{-3, 5, 297, 125};

double largest_difference(const ColourImage& a, const ColourImage& b) {
  double largest = 0;
  test::for_each_in(a.window(), [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      largest = std::max(largest, std::abs(static_cast<double>(a.get(x, y, c)) - static_cast<double>(b.get(x, y, c))));
    }
  });
  return largest;
}

class LeftOverOfVisibility : public testing::TestWithParam<const char*> {};

TEST_P(LeftOverOfVisibility, BoundsTheErrorAfterAnyBudgetAndHistory) {
  double tightest = 1e9;
  for (const bool with_alpha : {false, true}) {
    test::RandomShot shot(window, 11, SampleType::half, with_alpha, false);
    FilterOptions options = options_up_to(20);
    options.visibility = parse_visibility(GetParam());
    IncrementalFilter filter(window, options);
    LinearFilter linear(window, options);
    for (int frame = 0; frame < 24; ++frame) {
      if (frame > 0) shot.step();
      const CocFunction coc = test::random_lens(shot.random(), 20);
      filter.set_budget({Budget::Kind::percent, frame % 3 == 2 ? 100. : 7.});
      const Stats& stats = filter.filter(shot.frame(), coc);
      linear.filter(shot.frame(), coc);
      const LeftOver left = filter.left_over();
      EXPECT_EQ(left.pixels, stats.left_over);
      const double error = largest_difference(filter.result(), linear.result());
      EXPECT_LE(error, left.error_bound + 1e-5) << GetParam() << ", frame " << frame;
      if (stats.left_over == 0) {
        EXPECT_EQ(left.error_bound, 0);
        EXPECT_EQ(left.share, 0);
      } else if (error > 0) {
        tightest = std::min(tightest, left.error_bound / error);
      }
    }
  }
  EXPECT_LT(tightest, 50);  // it says something
}
INSTANTIATE_TEST_SUITE_P(Visibilities, LeftOverOfVisibility, testing::Values("none", "layers", "bitmap:32"));

TEST(LeftOver, IsBoundedByWhatLiesNearTheWaitingPixels) {
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 3);
  frame.colour.set(window.x1 - 1, window.y1 - 1, 0, 1000);  // far from what will wait
  IncrementalFilter filter(window, options_up_to(20));
  filter.filter(frame, coc_as_depth);
  frame.colour.set(0, 10, 1, 0.75f);
  filter.set_budget({Budget::Kind::count, 0});
  filter.filter(frame, coc_as_depth);
  const LeftOver left = filter.left_over();
  EXPECT_EQ(left.pixels, 1);
  EXPECT_EQ(left.error_bound, 0.25);
  EXPECT_GT(left.share, 0);
  EXPECT_LT(left.share, 0.2);
}

TEST(LeftOver, HasAnImportanceWhereAPixelWaitsAndNoneElsewhere) {
  test::RandomShot shot(window, 13, SampleType::half, true, false);
  FilterOptions options = options_up_to(20);
  options.importance.order = Order::fearing;  // no waiting pixel has the importance 0
  IncrementalFilter filter(window, options);
  filter.set_budget({Budget::Kind::percent, 30});
  Plane importance;
  for (int frame = 0; frame < 8; ++frame) {
    if (frame > 0) shot.step();
    const Stats& stats = filter.filter(shot.frame(), test::random_lens(shot.random(), 20));
    filter.left_over_importance(importance);
    ASSERT_EQ(importance.window(), window);
    std::int64_t waiting = 0;
    test::for_each_in(window, [&](int x, int y) {
      EXPECT_GE(importance.at(x, y), 0);
      waiting += importance.at(x, y) > 0;
    });
    EXPECT_EQ(waiting, stats.left_over);
  }
}

TEST(LeftOver, OfTheLinearFilterIsNothing) {
  LinearFilter linear(window, options_up_to(20));
  linear.filter(flat_frame(window, SampleType::half, {1, 1, 1}, 3), coc_as_depth);
  EXPECT_EQ(linear.left_over().pixels, 0);
  Plane importance;
  linear.left_over_importance(importance);
  EXPECT_EQ(importance.at(0, 10), 0);
}

TEST(Budgets, MayChangeFromCallToCallAndAreChecked) {
  Frame frame = flat_frame(window, SampleType::half, {1, 1, 1}, 3);
  IncrementalFilter filter(window, options_up_to(20));
  filter.filter(frame, coc_as_depth);
  frame = flat_frame(window, SampleType::half, {2, 1, 1}, 3);
  filter.set_budget({Budget::Kind::count, 100});
  EXPECT_EQ(filter.filter(frame, coc_as_depth).updated, 100);
  EXPECT_THROW(filter.set_budget({Budget::Kind::percent, 0}), Error);
  EXPECT_EQ(filter.filter(frame, coc_as_depth).updated, 100);  // the one before still holds
  filter.set_budget({Budget::Kind::percent, 100});
  EXPECT_EQ(filter.filter(frame, coc_as_depth).left_over, 0);
}

TEST(Budgets, OfTimeAllowARebuildThatEndsInTimeThoughTheCallCouldBeStopped) {
  test::RandomShot shot(window, 5, SampleType::half, true, false);
  FilterOptions options = options_up_to(20);
  options.clock = [] { return 0.; };
  options.budget = {Budget::Kind::time, 1e6};
  IncrementalFilter filter(window, options);
  EXPECT_EQ(filter.filter(shot.frame(), test::random_lens(shot.random(), 20), [] { return false; }).mode,
            ScatterMode::rebuild);
}

}  // namespace
}  // namespace pullfocus
