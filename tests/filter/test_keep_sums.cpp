// When a rebuild keeps its sums, and when those that were not kept are made.
#include <gtest/gtest.h>

#include "filter/linear_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::RandomShot;

constexpr auto half = SampleType::half;

// Frames of a shot in which each pixel has a colour and a depth of its own.
class KeptSums : public testing::Test {
 protected:
  static constexpr Window window{0, 0, 150, 70};

  Frame full_change() {
    ++drawn_;
    return RandomShot(window, drawn_, half, false, false).frame();
  }
  const Stats& filter(const Frame& frame, const StopRequest& stop = {}) { return filter_.filter(frame, coc_, stop); }
  void expect_linear(const Frame& frame) {
    linear_.filter(frame, coc_);
    ASSERT_EQ(test::difference(filter_.result(), linear_.result()), "");
    ASSERT_TRUE(test::invariant_holds(filter_, *kernels_));
  }

  const FilterOptions options_ = test::options_up_to(12);
  const std::shared_ptr<const KernelTable> kernels_ = std::make_shared<const KernelTable>(options_.kernel);
  IncrementalFilter filter_{window, options_, kernels_};
  LinearFilter linear_{window, options_, kernels_};
  const CocFunction coc_{DepthKind::planar, 9, 0.4f};
  unsigned drawn_ = 0;
};

TEST_F(KeptSums, OfRepeatedRebuildsAreForgottenAndThoseOfTheFirstFrameAreNot) {
  filter(full_change());
  EXPECT_TRUE(filter_.keeps_sums());
  for (int frame = 0; frame < 4; ++frame) {
    const Frame next = full_change();
    EXPECT_EQ(filter(next).mode, ScatterMode::rebuild);
    EXPECT_FALSE(filter_.keeps_sums());
    EXPECT_EQ(filter(next).mode, ScatterMode::unchanged);
    EXPECT_FALSE(filter_.keeps_sums());
    expect_linear(next);
  }
}

TEST_F(KeptSums, AreMadeForASmallChangeAtTheWorkOfOneRebuild) {
  for (int frame = 0; frame < 3; ++frame) filter(full_change());
  Frame next = full_change();
  filter(next);
  ASSERT_FALSE(filter_.keeps_sums());
  next.colour.set(60, 30, 1, 0.25f);
  const Stats made = filter(next);
  EXPECT_EQ(made.mode, ScatterMode::incremental);  // as if the sums had been there
  EXPECT_EQ(made.updated, 1);
  EXPECT_TRUE(filter_.keeps_sums());
  expect_linear(next);
  EXPECT_EQ(made.edges, linear_.filter(next, coc_).edges);
  next.colour.set(61, 31, 1, 0.25f);
  EXPECT_LT(filter(next).edges, 1000);
  expect_linear(next);
}

TEST_F(KeptSums, AreMadeBeforeTheFirstSliceOfACallThatCanBeStopped) {
  for (int frame = 0; frame < 2; ++frame) filter(full_change());
  const Frame last = full_change(), next = full_change();
  filter(last);
  EXPECT_EQ(filter(next, [] { return true; }).edges, 0);
  EXPECT_FALSE(filter_.keeps_sums());
  ASSERT_TRUE(test::invariant_holds(filter_, *kernels_));
  const Stats made = filter_.refine([] { return false; });
  EXPECT_EQ(made.left_over, 0);
  EXPECT_TRUE(filter_.keeps_sums());
  expect_linear(next);

  IncrementalFilter keeping(window, options_, kernels_);
  keeping.filter(last, coc_);
  const std::int64_t of_change = keeping.filter(next, coc_, [] { return false; }).edges;
  EXPECT_EQ(made.edges, linear_.filter(last, coc_).edges + of_change);
}

TEST_F(KeptSums, ANumberOfPixelsAsBudgetIsServedToTheLastOneWithoutThem) {
  FilterOptions options = options_;
  options.budget = {Budget::Kind::count, 10000};
  IncrementalFilter some(window, options, kernels_);
  for (int frame = 0; frame < 6; ++frame) {
    const Stats& stats = some.filter(full_change(), coc_);
    ASSERT_EQ(some.keeps_sums(), frame == 0);
    ASSERT_EQ(stats.updated, frame == 0 ? 10500 : 10000);
    ASSERT_TRUE(test::invariant_holds(some, *kernels_));
  }
}

TEST_F(KeptSums, ResetForgetsThatTheyWereMissed) {
  for (int miss = 0; miss < 3; ++miss) {
    for (int frame = 0; frame < 6; ++frame) filter(full_change());
    Frame next = full_change();
    filter(next);
    next.colour.set(60, 30, 1, 0.25f);
    filter(next);
  }
  filter(full_change());
  filter(full_change());
  EXPECT_TRUE(filter_.keeps_sums());
  filter_.reset();
  filter(full_change());
  filter(full_change());
  EXPECT_FALSE(filter_.keeps_sums());
}

TEST_F(KeptSums, AreMadeForAFrameOfAnotherTypeThatChangesNothing) {
  for (int frame = 0; frame < 2; ++frame) filter(full_change());
  Frame next = full_change();
  filter(next);
  ASSERT_FALSE(filter_.keeps_sums());
  Frame wide = next;
  widen(next.colour, wide.colour);
  EXPECT_EQ(filter(wide).mode, ScatterMode::unchanged);
  EXPECT_EQ(filter_.result().type(), SampleType::float32);
  expect_linear(wide);
}

TEST_F(KeptSums, AreAlwaysKeptUnderATimeBudget) {
  FilterOptions options = options_;
  options.budget = {Budget::Kind::time, 1e6};
  IncrementalFilter timed(window, options, kernels_);
  for (int frame = 0; frame < 6; ++frame) {
    timed.filter(full_change(), coc_);
    ASSERT_TRUE(timed.keeps_sums());
  }
}

}  // namespace
}  // namespace pullfocus
