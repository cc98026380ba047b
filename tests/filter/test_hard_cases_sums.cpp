// The proven bound of the sums, reached; and budgets where no pixel is more important than another.
#include <gtest/gtest.h>

#include <cmath>

#include "camera/usage.h"
#include "hard_measures.h"
#include "hard_shots.h"
#include "plain_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

constexpr test::WideSum one = 1;

TEST(HardSums, TheLargestSumsAreExactAndNearTheBound) {
  for (const double max_coc : {1., 7., 30., 120.}) {
    for (const float radiance : {65504.f, 0.f}) {
      const test::LargestSum sum = test::largest_sum(max_coc, radiance);
      EXPECT_EQ(sum.positive == sum.expected, true) << max_coc << " px, radiance " << sum.radiance;
      EXPECT_EQ(sum.negative == -sum.expected, true) << max_coc << " px, radiance " << sum.radiance;
      EXPECT_EQ(sum.expected < one << 63, true);
      // B is the sum of the very weights used here, so nothing is lost between the bound and the worst frame.
      EXPECT_NEAR(sum.share(), sum.overlap * static_cast<double>(sum.radiance) * 0x1p-23, 1e-9);
      if (radiance == 0) {
        EXPECT_GT(sum.share(), 0.99999) << max_coc;
      }
    }
  }
}

TEST(HardSums, ARadianceBeyondTheBoundIsRefused) {
  for (const double max_coc : {1., 30., 400.}) {
    FilterOptions options;
    options.kernel.max_coc_px = max_coc;
    options.kernel.max_radiance = test::largest_radiance(max_coc);
    EXPECT_NO_THROW(make_incremental_filter({0, 0, 4, 4}, options)) << max_coc;
    options.kernel.max_radiance = std::nextafter(options.kernel.max_radiance, INFINITY);
    expect_usage_error([&] { make_incremental_filter({0, 0, 4, 4}, options); }, "--max-radiance");
    expect_usage_error([&] { make_linear_filter({0, 0, 4, 4}, options); }, "--max-radiance");
  }
}

// The worst frame, in and out again a hundred times, around a wrap of 2^63 if there were one.
TEST(HardSums, TheLargestSumsComeAndGoWithoutATrace) {
  FilterOptions options = test::options_up_to(12);
  options.kernel.max_radiance = test::largest_radiance(12);
  const float most = options.kernel.max_radiance;
  const Window window{0, 0, 15, 15};
  IncrementalFilter filter(window, options);
  Frame frame = test::flat_frame(window, SampleType::float32, {1e-5f, 0, 0, 1}, 12);
  filter.filter(frame, test::coc_as_depth);
  const auto sums = test::sums_with_alpha(filter);
  const ColourImage picture = filter.result();
  for (int f = 0; f < 200; ++f) {
    test::for_each_in(window, [&](int x, int y) {
      const float sign = test::uniform(30, f, y * 15 + x, 0, 0, 1) < 0.5f ? -1 : 1;
      test::set_colour(frame.colour, x, y, {f % 2 ? 1e-5f : most, f % 2 ? 0 : sign * most, 0, 1});
      frame.depth.at(x, y) = f % 2 ? 12 : test::uniform(30, f, y * 15 + x, 1, 0, 12);
    });
    filter.filter(frame, test::coc_as_depth);
    if (f % 2) {
      ASSERT_TRUE(test::sums_with_alpha(filter) == sums) << f;
    }
    if (f % 2) {
      ASSERT_EQ(test::difference(filter.result(), picture), "") << f;
    }
  }
}

TEST(HardBudget, InASingleBucketNobodyStarvesAndNoRegionIsFavoured) {
  for (const double percent : {5., 10., 50.}) {
    const Budget budget{Budget::Kind::percent, percent};
    const test::OneBucket is = test::one_bucket(budget, 60);
    EXPECT_TRUE(is.exact) << percent;
    EXPECT_LE(is.longest_wait, budget.longest_wait()) << percent;
    // Six standard deviations of a random choice.
    const double spread = 6 * std::sqrt(is.per_block * (1 - percent / 100));
    EXPECT_GE(is.fewest, is.per_block - spread) << percent;
    EXPECT_LE(is.most, is.per_block + spread) << percent;
  }
}

TEST(HardBudget, UnderACountNobodyStarvesEither) {
  const test::OneBucket is = test::one_bucket({Budget::Kind::count, 400}, 60);
  EXPECT_TRUE(is.exact);
  EXPECT_LE(is.longest_wait, 128 * 64 / 200) << "half of the budget serves the oldest";
  EXPECT_LE(is.most, is.per_block + 6 * std::sqrt(is.per_block));
}

// Colours, depths, alpha and sample type change; a budget of 0 takes none of it.
TEST(HardBudget, OfZeroLeavesSumsAndPictureAsTheyWere) {
  const Window window{0, 0, 70, 20};
  FilterOptions options = test::options_up_to(12);
  options.budget = Budget::parse("0");
  IncrementalFilter filter(window, options);
  test::Footprints footprints(window, std::make_shared<const KernelTable>(options.kernel));
  Frame frame = test::flat_frame(window, SampleType::half, {0.3f, 65504, -2, 1}, 5);
  EXPECT_EQ(filter.filter(frame, test::coc_as_depth).updated, 1400) << "the first frame is done in full";
  const auto sums = test::sums_with_alpha(filter);
  const ColourImage picture = filter.result();
  for (int f = 1; f <= 6; ++f) {
    frame = test::flat_frame(window, f % 2 ? SampleType::float32 : SampleType::half, {1, 2, 3, f < 3 ? 1.f : 0.5f}, 7);
    const Stats& stats = filter.filter(frame, test::coc_as_depth);
    EXPECT_EQ(stats.changed, 1400);
    EXPECT_EQ(stats.left_over, 1400);
    EXPECT_EQ(stats.mode, ScatterMode::unchanged);
    ASSERT_TRUE(test::sums_with_alpha(filter) == sums) << f;
    ASSERT_TRUE(test::holds(filter, test::wide_sums(filter.committed(), footprints))) << f;
    ASSERT_EQ(test::difference(filter.result(), picture), "") << f;
  }
}

}  // namespace
}  // namespace pullfocus
