// --error-bound: attempts to drive the result farther from the linear filter's than was promised.
#include <gtest/gtest.h>

#include <cmath>

#include "camera/usage.h"
#include "filter/incremental_filter.h"
#include "plain_frames.h"
#include "random_frames.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

const Window window{0, 0, 70, 40};

// What was promised: the bound, the fixed point of the sums, and the rounding of the results.
double allowed(double bound, double value, SampleType type) {
  const double rounding = type == SampleType::half ? 0x1p-11 : 0x1p-24;
  return bound + 1e-7 + 2 * rounding * std::max(std::fabs(value), 0x1p-14);
}

class Bounded {
 public:
  explicit Bounded(double bound, SampleType result = SampleType::float32)
      : bound_(bound),
        options_(options(bound, result)),
        bounded_(window, options_),
        linear_(make_linear_filter(window, options_)) {}

  // Filters both ways and returns the largest difference as a share of the bound.
  double filter(const Frame& frame, const CocFunction& coc = coc_as_depth) {
    stats_ = bounded_.filter(frame, coc);
    linear_->filter(frame, coc);
    double largest = 0;
    for_each_in(window, [&](int x, int y) {
      for (int c = 0; c < 4; ++c) {
        const double is = static_cast<double>(bounded_.result().get(x, y, c));
        const double should_be = static_cast<double>(linear_->result().get(x, y, c));
        ASSERT_LE(std::fabs(is - should_be), allowed(bound_, should_be, bounded_.result().type()))
            << x << "," << y << " channel " << c;
        largest = std::max(largest, std::fabs(is - should_be));
      }
    });
    return largest / bound_;
  }
  const Stats& stats() const { return stats_; }

 private:
  static FilterOptions options(double bound, SampleType result) {
    FilterOptions options = options_up_to(25);
    options.error_bound = bound;
    options.output_type = result;
    return options;
  }
  double bound_;
  FilterOptions options_;
  IncrementalFilter bounded_;
  std::unique_ptr<Filter> linear_;
  Stats stats_;
};

TEST(ErrorBound, HoldsAndIsUsedUpWhenEveryPixelDriftsTheSameWay) {
  Bounded filter(0.25);
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f, 0.5f}, 9);
  filter.filter(frame);
  double largest = 0;
  for (int step = 1; step <= 40; ++step) {
    const float value = 0.5f + 0.03125f * static_cast<float>(step);
    for_each_in(window, [&](int x, int y) { test::set_colour(frame.colour, x, y, {value, 0.5f, 1 - value, value}); });
    largest = std::max(largest, filter.filter(frame));
    EXPECT_EQ(filter.stats().updated > 0, step % 9 == 0) << step;
  }
  EXPECT_NEAR(largest, 1, 1e-6);
}

TEST(ErrorBound, HoldsForRandomWalksOfColourAndAlphaBehindAnyBlur) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const double bound = std::exp2(-static_cast<double>(seed));
    Bounded filter(bound, seed % 2 ? SampleType::float32 : SampleType::half);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1), diameter(-25, 25);
    Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f, 0.5f}, 0);
    for_each_in(window, [&](int x, int y) { frame.depth.at(x, y) = diameter(random); });
    double largest = 0;
    for (int step = 0; step < 25; ++step) {
      for_each_in(window, [&](int x, int y) {
        for (int c = 0; c < 4; ++c) {
          const float drift = 0.4f * static_cast<float>(bound) * uniform(random);
          frame.colour.set(x, y, c, frame.colour.get(x, y, c) + drift);
        }
        if (random() % 500 == 0) frame.depth.at(x, y) = diameter(random);
      });
      largest = std::max(largest, filter.filter(frame));
      EXPECT_TRUE(step == 0 || filter.stats().updated < 70 * 40) << "nothing was saved, so nothing was tested";
    }
    EXPECT_GT(largest, 0.2);
  }
}

TEST(ErrorBound, HoldsWhenNeighboursDriftAgainstEachOtherAtTheBorderOfSharpAndBlurred) {
  Bounded filter(0.1);
  Frame frame = flat_frame(window, SampleType::float32, {1, 1, 1, 1}, 0);
  for_each_in({30, 0, 70, 40}, [&](int x, int y) { frame.depth.at(x, y) = 21; });
  filter.filter(frame);
  for (int step = 1; step <= 12; ++step) {
    for_each_in(window, [&](int x, int y) {
      const float drift = 0.03f * static_cast<float>(step) * ((x + y) % 2 ? 1.f : -1.f);
      test::set_colour(frame.colour, x, y, {1 + drift, 1 - drift, 1 + drift, 1});
    });
    filter.filter(frame);
  }
}

TEST(ErrorBound, HoldsForHostileShotsWithMovingFocus) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    test::RandomShot shot(window, seed, SampleType::half, true, true);
    Bounded filter(0.5);
    for (int frame = 0; frame < 8; ++frame) {
      if (frame > 0) shot.step();
      filter.filter(shot.frame(), test::random_lens(shot.random(), 25));
    }
  }
}

TEST(ErrorBound, NeverExemptsAChangeOfKernel) {
  Bounded filter(10);
  Frame frame = flat_frame(window, SampleType::float32, {1, 1, 1, 1}, 4);
  filter.filter(frame);
  frame.depth.at(9, 9) = 4.5f;
  filter.filter(frame);
  EXPECT_EQ(filter.stats().updated, 1);
  frame.depth.at(9, 9) = -4.5f;
  filter.filter(frame);
  EXPECT_EQ(filter.stats().updated, 1);
}

TEST(ErrorBound, IsRefusedWhereItWouldNotHold) {
  const auto refuses = [](auto&& change) {
    FilterOptions options = options_up_to(25);
    options.error_bound = 0.1;
    change(options);
    expect_usage_error([&] { make_incremental_filter(window, options); }, "--error-bound");
  };
  refuses([](FilterOptions& o) { o.budget.amount = 99; });
  refuses([](FilterOptions& o) { o.budget = {Budget::Kind::count, 1e9}; });
  refuses([](FilterOptions& o) { o.budget = {Budget::Kind::time, 1e6}; });
  refuses([](FilterOptions& o) { o.thresholds.coc_px = 0.5; });
  refuses([](FilterOptions& o) { o.thresholds.rgb = 0.01; });
  refuses([](FilterOptions& o) { o.error_bound = -1; });
  refuses([](FilterOptions& o) { o.error_bound = std::nan(""); });
}

}  // namespace
}  // namespace pullfocus
