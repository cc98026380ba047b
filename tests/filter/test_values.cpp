// Colours and depths that no renderer should write but some do: repaired, counted, and never visible as NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr SampleType types[] = {SampleType::half, SampleType::float32};
constexpr CocFunction lens{DepthKind::planar, 8, 0.5f};  // focused at 2; 4 px at infinity

bool all_finite(const ColourImage& image) {
  bool finite = true;
  for_each_in(image.window(), [&](int x, int y) {
    for (int c = 0; c < 4; ++c) finite &= std::isfinite(image.get(x, y, c));
  });
  return finite;
}

TEST(Values, NoOutputIsEverNaNOrInfinite) {
  const Window window{0, 0, 70, 33};
  for (const SampleType in : types) {
    for (const SampleType out : types) {
      FilterOptions options = options_up_to(20);
      options.output_type = out;
      options.kernel.max_radiance = 4e5f;
      options.slice_edges = 2000;
      test::RandomShot shot(window, 1 + static_cast<unsigned>(in), in, true, true);
      const auto linear = make_linear_filter(window, options), incremental = make_incremental_filter(window, options);
      for (int frame = 0; frame < 8; ++frame) {
        const CocFunction coc = test::random_lens(shot.random(), 40);
        int slices_left = frame;
        incremental->filter(shot.frame(), coc, [&] { return slices_left-- <= 0; });
        ASSERT_TRUE(all_finite(incremental->result())) << "frame " << frame;
        linear->filter(shot.frame(), coc);
        ASSERT_TRUE(all_finite(linear->result())) << "frame " << frame;
        shot.step();
      }
    }
  }
}

// A frame with known faults in more than one tile, and what is to be counted.
struct Faulty {
  Frame frame;
  std::int64_t colour = 0, depth = 0, radiance = 0, coc = 0;

  explicit Faulty(SampleType type) : frame(flat_frame({-10, 3, 120, 45}, type, {0.5f, 0.5f, 0.5f, 1}, 3.f)) {
    const Window& w = frame.window();
    const auto colour_at = [&](int x, int y, const test::Rgba& value) {
      test::set_colour(frame.colour, w.x0 + x, w.y0 + y, value);
    };
    const auto depth_at = [&](int x, int y, float value) { frame.depth.at(w.x0 + x, w.y0 + y) = value; };
    for (int i = 0; i < 5; ++i) colour_at(i * 30, i * 10, {nan, 0, -infinity, 1}), ++colour;
    colour_at(7, 7, {0, 0, 0, nan}), ++colour;
    colour_at(8, 7, {0, infinity, 50000.f, 1}), ++colour, ++radiance;  // both kinds in one pixel
    for (int i = 0; i < 4; ++i) colour_at(70 + i, 20, {-2000.f, 2000.f, 0, 1}), ++radiance;
    colour_at(71, 21, {1000.f, -1000.f, 0, 1});  // the largest that may pass
    for (const float bad : {nan, -infinity, -1.f, 0.f}) depth_at(10 + static_cast<int>(depth), 40, bad), ++depth;
    depth_at(66, 0, infinity), depth_at(66, 1, 1e10f), depth_at(66, 2, 1e9f);
    depth_at(90, 5, 0), colour_at(90, 5, {0, 0, 0, 0});
    for (int i = 0; i < 3; ++i) depth_at(100 + i, 30, 1e-3f), ++coc;
    depth_at(103, 30, 1e-42f), ++coc;
  }
};

TEST(Values, EveryRepairIsCountedInEveryFrameWhetherItChangedOrNot) {
  for (const SampleType type : types) {
    const Faulty faulty(type);
    FilterOptions options = options_up_to(20);
    options.kernel.max_radiance = 1000;
    const auto linear = make_linear_filter(faulty.frame.window(), options);
    const auto incremental = make_incremental_filter(faulty.frame.window(), options);
    for (int round = 0; round < 3; ++round) {
      for (Filter* filter : {linear.get(), incremental.get()}) {
        const Stats& stats = filter->filter(faulty.frame, lens);
        EXPECT_EQ(stats.repaired_colour, faulty.colour) << "round " << round;
        EXPECT_EQ(stats.repaired_depth, faulty.depth) << "round " << round;
        EXPECT_EQ(stats.clamped_radiance, faulty.radiance) << "round " << round;
        EXPECT_EQ(stats.clamped_coc, faulty.coc) << "round " << round;
      }
    }
  }
}

// Filters a frame of 9 x 5, in focus but for its centre, which has this colour and depth.
ColourImage with_centre(const test::Rgba& colour, float depth, SampleType type = SampleType::float32,
                        Stats* stats = nullptr, float max_radiance = 65504.f) {
  const Window window{0, 0, 9, 5};
  Frame frame = flat_frame(window, type, {0.25f, 0.5f, 0.75f, 1}, 2.f);
  test::set_colour(frame.colour, 4, 2, colour);
  frame.depth.at(4, 2) = depth;
  FilterOptions options = options_up_to(10);
  options.kernel.max_radiance = max_radiance;
  const auto filter = make_linear_filter(window, options);
  const Stats& is = filter->filter(frame, lens);
  if (stats != nullptr) *stats = is;
  return filter->result();
}

TEST(Values, NaNAndInfinityCountAs0) {
  const ColourImage expected = with_centre({0, 0, 0, 1}, 2.5f);
  EXPECT_EQ(test::difference(with_centre({nan, infinity, -infinity, 1}, 2.5f), expected), "");
  EXPECT_EQ(test::difference(with_centre({nan, infinity, -infinity, 1}, 2.5f, SampleType::half), expected), "");
}

TEST(Values, NegativeColoursPass) {
  for (const SampleType type : types) {
    EXPECT_EQ(with_centre({-2.5f, -1024.f, 0, 1}, 2.f, type).get(4, 2, 0), -2.5f);
    EXPECT_EQ(with_centre({-2.5f, -1024.f, 0, 1}, 2.f, type).get(4, 2, 1), -1024.f);
  }
}

TEST(Values, EveryBackgroundMeansInfinity) {
  const ColourImage expected = with_centre({1, 1, 1, 1}, infinity);
  for (const float depth : {1e9f, 1e10f, 3e38f, nan, -infinity, -2.f, 0.f, -0.f}) {
    EXPECT_EQ(test::difference(with_centre({1, 1, 1, 1}, depth), expected), "") << depth;
  }
}

TEST(Values, ADepthOf0IsEmptyWhereNothingShowsAndCountedWhereSomethingDoes) {
  for (const SampleType type : types) {
    Stats stats;
    with_centre({0, 0, 0, 0}, 0.f, type, &stats);
    EXPECT_EQ(stats.repaired_depth, 0);
    with_centre({0, 0, 0, 1e-3f}, 0.f, type, &stats);
    EXPECT_EQ(stats.repaired_depth, 1);
    with_centre({0, 0, 0, 0}, nan, type, &stats);
    EXPECT_EQ(stats.repaired_depth, 1);
    with_centre({0, 0, 0, 1}, 1e10f, type, &stats);
    EXPECT_EQ(stats.repaired_depth, 0);
  }
}

TEST(Values, AnAlphaThatCountsAs0ShowsNothing) {
  for (const SampleType type : types) {
    for (const float alpha : {nan, infinity}) {
      Stats stats;
      with_centre({0, 0, 0, alpha}, 0.f, type, &stats);
      EXPECT_EQ(stats.repaired_colour, 1);
      EXPECT_EQ(stats.repaired_depth, 0) << alpha << (type == SampleType::half ? " half" : " float");
    }
  }
}

TEST(Values, RadianceIsClampedAlikeForHalfAndFloat) {
  for (const float limit : {65504.f, 100.03f, 1.f}) {
    Stats as_half, as_float;
    const ColourImage a = with_centre({60000.f, -60000.f, 0.5f, 1}, 2.7f, SampleType::half, &as_half, limit);
    const ColourImage b = with_centre({60000.f, -60000.f, 0.5f, 1}, 2.7f, SampleType::float32, &as_float, limit);
    EXPECT_EQ(test::difference(a, b), "") << limit;
    EXPECT_EQ(as_half.clamped_radiance, limit < 60000.f);
    EXPECT_EQ(as_float.clamped_radiance, limit < 60000.f);
  }
  EXPECT_EQ(with_centre({5, -5, 0, 1}, 2.f, SampleType::half, nullptr, 2.f).get(4, 2, 0), 2.f);
  EXPECT_EQ(with_centre({5, -5, 0, 1}, 2.f, SampleType::half, nullptr, 2.f).get(4, 2, 1), -2.f);
}

TEST(Values, HalfResultsAreClampedInsteadOfOverflowing) {
  const Window window{0, 0, 20, 20};
  FilterOptions options = options_up_to(10);
  options.kernel.max_radiance = 2e5f;
  options.output_type = SampleType::half;
  const Frame frame = flat_frame(window, SampleType::float32, {1e5f, -1e5f, 65510.f, 1}, 3.f);
  const auto linear = make_linear_filter(window, options), incremental = make_incremental_filter(window, options);
  linear->filter(frame, lens);
  EXPECT_EQ(linear->result().get(9, 9, 0), 65504.f);
  EXPECT_EQ(linear->result().get(9, 9, 1), -65504.f);
  EXPECT_EQ(linear->result().get(9, 9, 2), 65504.f);
  incremental->filter(frame, lens, [] { return true; });  // shows the input
  EXPECT_EQ(test::difference(incremental->result(), linear->result()), "");
}

// Every source around the centre has the kernel that weighs most there, and the largest radiance allowed.
TEST(Values, TheLargestSumThatCanOccurStillFits) {
  const Window window{0, 0, 61, 61};
  FilterOptions options = options_up_to(30);
  const KernelTable trial(options.kernel);
  options.kernel.max_radiance = std::floor(static_cast<float>(0x1p23 / trial.overlap_bound())) - 2;
  const float most = options.kernel.max_radiance;
  Frame frame = flat_frame(window, SampleType::float32, {most, -most, most, most}, 0);
  for_each_in(window, [&](int x, int y) {
    std::int64_t largest = -1;
    for (int i = 0; i < trial.coc().size(); ++i) {
      const std::int64_t weight = trial.kernel(i).weight(30 - x, 30 - y);
      if (weight <= largest) continue;
      largest = weight;
      frame.depth.at(x, y) = static_cast<float>(trial.coc().diameter(i));
    }
  });
  const auto filter = make_linear_filter(window, options);
  filter->filter(frame, coc_as_depth);
  for (int c = 0; c < 4; ++c) {
    const float expected = c == 1 ? -most : most;
    EXPECT_NEAR(filter->result().get(30, 30, c), expected, 1e-6f * most);
  }
}

}  // namespace
}  // namespace pullfocus
