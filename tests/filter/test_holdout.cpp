// Held-out pixels: they contribute nothing and show their own colour, exactly, whatever is done around them.
#include <gtest/gtest.h>

#include "filter/explain.h"
#include "filter/incremental_filter.h"
#include "filter/linear_filter.h"
#include "filter/plan.h"
#include "image/error.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::RandomShot;

constexpr Window window{-4, 3, 61, 40};

// A blurred random frame; the mask is left to the test.
Frame busy_frame(SampleType type, bool with_alpha, unsigned seed) {
  return RandomShot(window, seed, type, with_alpha, false).frame();
}

CocFunction wide_lens() {
  std::mt19937 random(7);
  CocFunction coc = test::random_lens(random, 20);
  coc.scale = 20;
  return coc;
}

FilterOptions plain_options(SampleType output) {
  FilterOptions options;
  options.kernel.max_coc_px = 20;
  options.output_type = output;
  options.visibility.kind = VisibilityOptions::Kind::none;
  return options;
}

class Holdout : public testing::TestWithParam<const char*> {
 protected:
  static FilterOptions options_for(SampleType output) {
    FilterOptions options = plain_options(output);
    options.visibility = parse_visibility(GetParam());
    options.visibility.cutoff_px = 0.5;
    return options;
  }
};

bool in_mask(int x, int y) { return (x / 5 + y / 3) % 3 == 0; }

void draw_mask(Frame& frame, int shift) {
  frame.mask.reset(window, 0);
  test::for_each_in(window, [&](int x, int y) { frame.mask.at(x, y) = in_mask(x + shift, y) ? 0.5f : 0.49f; });
}

TEST_P(Holdout, ShowsItsOwnColourExactlyInEveryTypeWithAndWithoutAlpha) {
  for (const SampleType in : {SampleType::half, SampleType::float32}) {
    for (const SampleType out : {SampleType::half, SampleType::float32}) {
      for (const bool with_alpha : {false, true}) {
        Frame frame = busy_frame(in, with_alpha, 1);
        draw_mask(frame, 0);
        LinearFilter filter(window, options_for(out));
        filter.filter(frame, wide_lens());
        ColourImage own(window, out);
        test::for_each_in(window, [&](int x, int y) {
          if (!in_mask(x, y)) return;
          for (int c = 0; c < 4; ++c) {
            own.set(x, y, c, frame.colour.get(x, y, c));
            ASSERT_EQ(filter.result().get(x, y, c), own.get(x, y, c)) << x << "," << y;
          }
        });
      }
    }
  }
}

TEST_P(Holdout, ShowsItsSanitisedColourAndNeverInfinity) {
  Frame frame = busy_frame(SampleType::float32, true, 2);
  frame.mask.reset(window, 1);
  const float samples[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e38f,
                           0.25f};
  for (int c = 0; c < 4; ++c) frame.colour.set(0, 5, c, samples[c]);
  LinearFilter filter(window, options_for(SampleType::half));
  filter.filter(frame, wide_lens());
  EXPECT_EQ(filter.result().get(0, 5, 0), 0);
  EXPECT_EQ(filter.result().get(0, 5, 1), 0);
  EXPECT_EQ(filter.result().get(0, 5, 2), 65504);
  EXPECT_EQ(filter.result().get(0, 5, 3), 0.25f);
}

TEST_P(Holdout, ContributesNothingToAnyone) {
  Frame frame = busy_frame(SampleType::float32, true, 3), other = frame;
  draw_mask(frame, 0);
  other.mask = frame.mask;
  test::for_each_in(window, [&](int x, int y) {
    if (!in_mask(x, y)) return;
    for (int c = 0; c < 4; ++c) other.colour.set(x, y, c, 900.f);
    other.depth.at(x, y) = 0.3f;
  });
  LinearFilter a(window, options_for(SampleType::float32)), b(window, options_for(SampleType::float32));
  a.filter(frame, wide_lens());
  b.filter(other, wide_lens());
  test::for_each_in(window, [&](int x, int y) {
    if (in_mask(x, y)) return;
    for (int c = 0; c < 4; ++c) ASSERT_EQ(a.result().get(x, y, c), b.result().get(x, y, c)) << x << "," << y;
  });
}

TEST(HoldoutOfPlainScatter, AgreesWithThePlainTwin) {
  Frame frame = busy_frame(SampleType::float32, true, 4);
  draw_mask(frame, 2);
  const FilterOptions options = plain_options(SampleType::float32);
  const KernelTable kernels(options.kernel);
  LinearFilter filter(window, options);
  filter.filter(frame, wide_lens());
  const test::NaiveImage expected = test::naive_scatter(frame, wide_lens(), kernels);
  test::for_each_in(window, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      const double value = expected.at(x, y, c);
      ASSERT_NEAR(filter.result().get(x, y, c), value, 1e-6 * std::max(1., std::abs(value))) << x << "," << y;
    }
  });
}

TEST_P(Holdout, AMaskOfNothingChangesNoBitAndAMaskOfEverythingIsTheInput) {
  Frame frame = busy_frame(SampleType::half, true, 5), masked = frame;
  const FilterOptions options = options_for(SampleType::half);
  LinearFilter plain(window, options), linear(window, options);
  IncrementalFilter incremental(window, options);
  plain.filter(frame, wide_lens());
  masked.mask.reset(window, 0);
  linear.filter(masked, wide_lens());
  incremental.filter(masked, wide_lens());
  EXPECT_EQ(test::difference(plain.result(), linear.result()), "");
  EXPECT_EQ(test::difference(plain.result(), incremental.result()), "");
  EXPECT_EQ(incremental.filter(frame, wide_lens()).mode, ScatterMode::unchanged);

  masked.mask.reset(window, 1);
  EXPECT_EQ(linear.filter(masked, wide_lens()).edges, 0);
  incremental.filter(masked, wide_lens());
  EXPECT_EQ(test::difference(linear.result(), frame.colour), "");
  EXPECT_EQ(test::difference(incremental.result(), frame.colour), "");
  for (int layer = 0; layer < incremental.layers().count(); ++layer) {
    for (const Accumulator sum : incremental.accumulators(layer)) ASSERT_EQ(sum, 0u);
  }
}

TEST_P(Holdout, AChangeOfColourAloneIsShownThoughNothingIsScattered) {
  Frame frame = busy_frame(SampleType::half, true, 6);
  frame.mask.reset(window, 0);
  frame.mask.at(20, 20) = 1;
  const FilterOptions options = options_for(SampleType::half);
  IncrementalFilter incremental(window, options);
  LinearFilter linear(window, options);
  incremental.filter(frame, wide_lens());
  frame.colour.set(20, 20, 1, 7.f);
  const Stats& stats = incremental.filter(frame, wide_lens());
  EXPECT_EQ(stats.updated, 1);
  EXPECT_EQ(stats.edges, 0);
  EXPECT_EQ(incremental.result().get(20, 20, 1), 7.f);
  frame.depth.at(20, 20) += 1;
  EXPECT_EQ(incremental.filter(frame, wide_lens()).mode, ScatterMode::unchanged);  // its depth is of no consequence
  linear.filter(frame, wide_lens());
  EXPECT_EQ(test::difference(incremental.result(), linear.result()), "");
}

TEST_P(Holdout, AMovingMaskUnderBudgetsAndThresholdsEndsExactOnceRefined) {
  Frame frame = busy_frame(SampleType::half, true, 8);
  FilterOptions options = options_for(SampleType::float32);
  LinearFilter linear(window, options);
  options.budget = Budget::parse("20%");
  options.slice_edges = 200;
  IncrementalFilter incremental(window, options);
  options.budget = Budget{};
  options.thresholds = {100, 1000};
  IncrementalFilter tolerant(window, options);
  options.thresholds = {};
  options.error_bound = 1;
  IncrementalFilter bounded(window, options);
  for (int step = 0; step < 6; ++step) {
    draw_mask(frame, step);
    int slices = 5;
    incremental.filter(frame, wide_lens(), [&] { return slices-- == 0; });
    test::for_each_in(window, [&](int x, int y) {
      const auto at = static_cast<std::size_t>(y - window.y0) * window.width() + (x - window.x0);
      if (incremental.committed().index[at] != kHeldOut) return;
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(incremental.result().get(x, y, c), incremental.committed().colour.get(x, y, c)) << x << "," << y;
      }
    });
    if (step % 2) incremental.refine();
    linear.filter(frame, wide_lens());
    if (step % 2) {
      ASSERT_EQ(test::difference(incremental.result(), linear.result()), "") << step;
    }
    tolerant.filter(frame, wide_lens());  // no threshold is wide enough to miss that a pixel is held out or released
    ASSERT_EQ(test::difference(tolerant.result(), linear.result()), "") << step;
    bounded.filter(frame, wide_lens());
    ASSERT_EQ(test::difference(bounded.result(), linear.result()), "") << step;
  }
}

TEST_P(Holdout, DoesNotWidenTheOutputWindowByBlurItDoesNotCause) {
  Frame frame = test::empty_frame(window, SampleType::half, DepthKind::coc);
  test::set_colour(frame.colour, 20, 20, {1, 1, 1, 1});
  frame.depth.at(20, 20) = 9;
  LinearFilter filter(window, options_for(SampleType::half));
  filter.filter(frame, test::coc_as_depth);
  EXPECT_GT(filter.result_window().width(), 5);
  frame.mask.reset(window, 0);
  frame.mask.at(20, 20) = 1;
  filter.filter(frame, test::coc_as_depth);
  EXPECT_EQ(filter.result_window(), (Window{20, 20, 21, 21}));
  EXPECT_EQ(filter.result().get(20, 20, 0), 1);
}

TEST_P(Holdout, ExplainAndPlanSayWhatIsHeldOut) {
  Frame frame = busy_frame(SampleType::half, true, 9);
  frame.mask.reset(window, 0);
  for (int x = 18; x < 23; ++x) frame.mask.at(x, 20) = 1;
  const FilterOptions options = options_for(SampleType::half);
  const KernelTable kernels(options.kernel);
  const Explanation held = explain(frame, wide_lens(), kernels, 20, 20, 1000, options.visibility);
  EXPECT_TRUE(held.held_out);
  EXPECT_EQ(held.own_share, 1);
  const Explanation beside = explain(frame, wide_lens(), kernels, 20, 21, 1000, options.visibility);
  EXPECT_FALSE(beside.held_out);
  for (const Contributor& c : beside.largest) EXPECT_FALSE(frame.holds_out(c.x, c.y));
  EXPECT_EQ(make_plan(options, kernels, frame, wide_lens(), nullptr, {}).held_out, 5);
}

INSTANTIATE_TEST_SUITE_P(Visibilities, Holdout,
                         testing::Values("none", "layers", "layers:-6,-1,0,3", "bitmap:32", "bitmap:4"));

TEST(HoldoutMask, OverAnotherWindowIsRefused) {
  Frame frame = busy_frame(SampleType::half, true, 10);
  frame.mask.reset({0, 0, 5, 5}, 0);
  LinearFilter linear(window, plain_options(SampleType::half));
  EXPECT_THROW(linear.filter(frame, wide_lens()), Error);
}

}  // namespace
}  // namespace pullfocus
