// Colour metrics, and what each order puts first.
#include <gtest/gtest.h>

#include <cmath>

#include "camera/usage.h"
#include "filter/incremental_filter.h"
#include "image/error.h"
#include "plain_frames.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::options_up_to;
using test::set_colour;

const Window window{0, 0, 120, 60};

// L*u*v* under D65 of the primaries of Rec. 709, as tabulated for sRGB.
TEST(Cieluv, AgreesWithTabulatedColours) {
  const ColourMetric metric(ColourDistance::cieluv);
  const struct {
    std::array<double, 3> rgb, luv;
  } known[] = {{{1, 1, 1}, {100, 0, 0}},
               {{0, 0, 0}, {0, 0, 0}},
               {{1, 0, 0}, {53.24, 175.01, 37.76}},
               {{0, 1, 0}, {87.73, -83.08, 107.40}},
               {{0, 0, 1}, {32.30, -9.41, -130.35}},
               {{0.18418652, 0.18418652, 0.18418652}, {50, 0, 0}}};
  for (const auto& colour : known) {
    const auto luv = metric(colour.rgb);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(100 * luv[i], colour.luv[i], 0.06) << colour.rgb[0];
  }
}

TEST(Cieluv, UsesTheChromaticitiesGiven) {
  Chromaticities wide;
  wide.red = {0.708, 0.292};
  wide.green = {0.170, 0.797};
  wide.blue = {0.131, 0.046};
  const auto narrow_green = ColourMetric(ColourDistance::cieluv)({0, 1, 0});
  const auto wide_green = ColourMetric(ColourDistance::cieluv, wide)({0, 1, 0});
  EXPECT_GT(std::hypot(wide_green[1], wide_green[2]), std::hypot(narrow_green[1], narrow_green[2]));
  wide.green = wide.red;
  EXPECT_THROW(ColourMetric(ColourDistance::cieluv, wide), Error);
}

TEST(Cieluv, IsFiniteForEveryColourAndContinuousAtBlack) {
  const ColourMetric metric(ColourDistance::cieluv);
  for (const double r : {-65504., -1., -1e-9, 0., 1e-9, 1., 65504.}) {
    for (const double g : {-65504., -1., 0., 1., 65504.}) {
      for (const double b : {-65504., 0., 65504.}) {
        for (const double value : metric({r, g, b})) EXPECT_TRUE(std::isfinite(value)) << r << " " << g << " " << b;
      }
    }
  }
  EXPECT_NEAR(metric({1e-9, 1e-9, 1e-9})[0], metric({-1e-9, -1e-9, -1e-9})[0], 1e-6);
}

TEST(RgbDistance, LeavesColoursAsTheyAre) { EXPECT_EQ(ColourMetric()({-1, 2, 3}), (std::array<double, 3>{-1, 2, 3})); }

TEST(OrderNames, AreReadAndOthersRefused) {
  for (const Order order : {Order::gain, Order::fearing, Order::random}) EXPECT_EQ(parse_order(name(order)), order);
  for (const ColourDistance d : {ColourDistance::rgb, ColourDistance::cieluv}) {
    EXPECT_EQ(parse_colour_distance(name(d)), d);
  }
  expect_usage_error([] { parse_order("best"); }, "--order");
  expect_usage_error([] { parse_colour_distance("lab"); }, "--colour-distance");
}

TEST(BucketCount, AnyNumberOfBucketsIsMonotoneAndReachesBothEnds) {
  for (const int buckets : {1, 2, 3, 7, 194, kMostBuckets}) {
    int before = 1;
    for (double h = 0x1p-14; h < 0x1p14; h *= 1.01) {
      const int bucket = bucket_of(h, buckets);
      ASSERT_GE(bucket, before);
      ASSERT_LE(bucket, buckets);
      before = bucket;
    }
    EXPECT_EQ(before, buckets);
    EXPECT_EQ(bucket_of(0, buckets), 1);
  }
  FilterOptions options = options_up_to(4);
  for (const int wrong : {0, -1, kMostBuckets + 1}) {
    options.importance.buckets = wrong;
    expect_usage_error([&] { make_incremental_filter(window, options); }, "--buckets");
  }
}

// Two pixels far apart change; a budget of one. Says whether the first was taken.
class Rivals {
 public:
  explicit Rivals(Order order, ColourDistance distance = ColourDistance::rgb) {
    options_ = options_up_to(30);
    options_.budget = {Budget::Kind::count, 1};
    options_.importance.order = order;
    options_.importance.metric = ColourMetric(distance);
  }
  struct Pixel {
    test::Rgba before, after;
    float coc_before, coc_after;
  };
  bool first_wins(const Pixel& first, const Pixel& second, const test::Rgba& around = {0.5f, 0.5f, 0.5f}, int y = 30,
                  float around_coc = 0) const {
    IncrementalFilter filter(window, options_);
    Frame frame = flat_frame(window, SampleType::float32, around, around_coc);
    set(frame, 30, y, first.before, first.coc_before);
    set(frame, 90, y, second.before, second.coc_before);
    filter.filter(frame, coc_as_depth);
    set(frame, 30, y, first.after, first.coc_after);
    set(frame, 90, y, second.after, second.coc_after);
    EXPECT_EQ(filter.filter(frame, coc_as_depth).updated, 1);
    const SourceState& state = filter.committed();
    const KernelTable table(options_.kernel);
    return state.colour.get(30, y, 0) == first.after.r && state.colour.get(30, y, 1) == first.after.g &&
           state.colour.get(30, y, 2) == first.after.b &&
           state.index[static_cast<std::size_t>(y * 120 + 30)] == table.coc().index(first.coc_after);
  }

 private:
  static void set(Frame& frame, int x, int y, const test::Rgba& colour, float coc) {
    set_colour(frame.colour, x, y, colour);
    frame.depth.at(x, y) = coc;
  }
  FilterOptions options_;
};

constexpr test::Rgba black{0, 0, 0}, grey{0.5f, 0.5f, 0.5f}, white{1, 1, 1};

TEST(GainOrder, PutsSharpChangesOfColourBeforeBlurredOnes) {
  const Rivals gain(Order::gain);
  EXPECT_TRUE(gain.first_wins({grey, white, 0, 0}, {grey, white, 20, 20}));
  EXPECT_FALSE(gain.first_wins({grey, white, 20, 20}, {grey, white, 0, 0}));
}

TEST(GainOrder, PutsAChangeOfBlurThatShowsBeforeALargerOneThatDoesNot) {
  // A grey pixel among grey ones may blur as it likes. All around are blurred, so that white pixels are not alone
  // where they are seen.
  const Rivals gain(Order::gain), fearing(Order::fearing);
  int wins = 0;
  const test::Rgba around = grey;
  for (int y = 5; y < 55; ++y) {
    EXPECT_TRUE(gain.first_wins({white, white, 2, 4}, {grey, grey, 0, 25}, around, y, 6)) << y;
    wins += gain.first_wins({white, white, 2, 5}, {white, white, 20, 25}, around, y, 6);
  }
  EXPECT_GE(wins, 45) << "of 50: gains of moves are taken times random numbers";
  EXPECT_FALSE(fearing.first_wins({white, white, 2, 4}, {grey, grey, 0, 25}));
  EXPECT_FALSE(fearing.first_wins({white, white, 2, 5}, {white, white, 20, 25}));
}

TEST(GainOrder, CountsUncoveredBackground) {
  // A sharp white pixel gives way to what is behind it.
  EXPECT_TRUE(Rivals(Order::gain).first_wins({white, grey, 0, 20}, {white, white, 2, 3}));
}

TEST(FearingOrder, ByCieluvPutsAChangeAmongDarkTonesBeforeTheSameAmongBrightOnes) {
  const test::Rgba dark{0.01f, 0.01f, 0.01f}, less_dark{0.05f, 0.05f, 0.05f}, bright{0.9f, 0.9f, 0.9f},
      brighter{0.95f, 0.95f, 0.95f};
  EXPECT_TRUE(
      Rivals(Order::fearing, ColourDistance::cieluv).first_wins({dark, less_dark, 0, 0}, {bright, brighter, 0, 0}));
  EXPECT_FALSE(
      Rivals(Order::fearing, ColourDistance::rgb).first_wins({dark, less_dark, 0, 0}, {bright, brighter, 0, 0}));
}

}  // namespace
}  // namespace pullfocus
