// The order in which a budget is spent.
#include "importance/importance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "filter/incremental_filter.h"
#include "importance/tile_row.h"
#include "plain_frames.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

constexpr auto float32 = SampleType::float32;
const Window window{0, 0, 150, 70};

constexpr int buckets = 194;

template <SampleType type>
void expect_opaque_as_pixel_by_pixel() {
  std::mt19937 random(5);
  std::vector<Pixel<type>> pixels(64);
  int opaque = 0;
  for (int round = 0; round < 2000; ++round) {
    const int n = 1 + static_cast<int>(random() % 64);
    for (auto& pixel : pixels) {
      for (auto& value : pixel.rgba) value = static_cast<std::remove_reference_t<decltype(value)>>(random());
      pixel.rgba[3] = kOne<type>;
    }
    // One bit of alpha, in or behind the row.
    auto& alpha = pixels[random() % 64].rgba[3];
    using Bits = std::remove_reference_t<decltype(alpha)>;
    if (round % 3 != 0) alpha = static_cast<Bits>(alpha ^ 1u << random() % (8 * sizeof(Bits)));
    const bool all = std::all_of(pixels.begin(), pixels.begin() + n, is_opaque<type>);
    ASSERT_EQ(are_opaque<type>(pixels.data(), n), all) << round;
    opaque += all;
  }
  EXPECT_GT(opaque, 700);
  EXPECT_LT(opaque, 1900);
}

TEST(TileRows, AreOpaqueIfEveryPixelOfThemIs) {
  expect_opaque_as_pixel_by_pixel<SampleType::half>();
  expect_opaque_as_pixel_by_pixel<SampleType::float32>();
}

TEST(TileRows, ReachAsFarAsTheLargestIndexOfASource) {
  std::mt19937 random(6);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::int16_t> index(1 + random() % 64);
    int largest = 0;
    for (auto& i : index) {
      const auto kind = random() % 8;
      i = kind == 0 ? kHeldOut : kind == 1 ? kNeverCommitted : static_cast<std::int16_t>(random() % 801 - 400);
      largest = std::max(largest, reach_index(i));
    }
    ASSERT_EQ(largest_reach(index.data(), static_cast<int>(index.size())), largest);
  }
}

TEST(Buckets, AreMonotoneEightAnOctaveAndBounded) {
  int before = bucket_of(0, buckets);
  EXPECT_EQ(before, 1);
  for (double h = 0x1p-14; h < 0x1p14; h *= 1.003) {
    const int bucket = bucket_of(h, buckets);
    ASSERT_GE(bucket, before);
    ASSERT_LE(bucket, before + 1);
    ASSERT_LE(bucket, buckets);
    if (h >= 0x1p-12 && h < 0x1p11) {
      ASSERT_EQ(bucket_of(2 * h, buckets), bucket + 8) << h;
    }
    before = bucket;
  }
}

TEST(Buckets, FirstAndLastHoldWhatLiesBeyond2ToThePlusMinus12) {
  EXPECT_EQ(bucket_of(std::nextafter(0x1p-12, 0), buckets), 1);
  EXPECT_EQ(bucket_of(0x1p-12, buckets), 2);
  EXPECT_LT(bucket_of(std::nextafter(0x1p12, 0), buckets), buckets);
  EXPECT_EQ(bucket_of(0x1p12, buckets), buckets);
  EXPECT_EQ(bucket_of(1e300, buckets), buckets);
  EXPECT_EQ(bucket_of(std::numeric_limits<double>::infinity(), buckets), buckets);
  EXPECT_EQ(bucket_of(std::nan(""), buckets), 1);
}

TEST(Scrambling, IsABijection) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < 100000; ++i) seen.insert(scrambled(i));
  for (std::uint32_t i = 0; i < 100000; ++i) seen.insert(scrambled(~i));
  EXPECT_EQ(seen.size(), 200000u);
}

// A first frame, then one in which every pixel changed by an amount of its own, done in part.
class Selection {
 public:
  Selection(double w_coc, double w_rgb, double pixels, int threads = 2)
      : options_(with(w_coc, w_rgb, pixels, threads)),
        filter_(window, options_),
        before_(flat_frame(window, float32, {0.5f, 0.5f, 0.5f, 1}, 2.f)),
        after_(before_) {}

  Frame& after() { return after_; }
  Stats run() {
    filter_.filter(before_, coc_as_depth);
    return filter_.filter(after_, coc_as_depth);
  }

  bool committed(int x, int y) const {
    const SourceState& state = filter_.committed();
    const CocTable& coc = table_.coc();
    return state.index[static_cast<std::size_t>(y) * window.width() + x] == coc.index(after_.depth.at(x, y)) &&
           std::memcmp(state.colour.pixel(x, y), after_.colour.pixel(x, y), 16) == 0;
  }

  // h of Fearing's equation 4, as the first frame saw it.
  double importance(int x, int y) const {
    const CocTable& coc = table_.coc();
    const auto signed_diameter = [&](float c) { return std::copysign(coc.diameter(coc.index(c)), c); };
    double rgb = 0;
    for (int c = 0; c < 3; ++c) {
      rgb += std::pow(static_cast<double>(after_.colour.get(x, y, c) - before_.colour.get(x, y, c)), 2);
    }
    const double moved = std::fabs(signed_diameter(after_.depth.at(x, y)) - signed_diameter(before_.depth.at(x, y)));
    return options_.importance.w_coc * moved + options_.importance.w_rgb * std::sqrt(rgb);
  }

  // No pixel that was left over lies in a higher bucket than one that was updated.
  void expect_most_important_first(std::int64_t pixels) const {
    int lowest_committed = kMostBuckets, highest_left = 0;
    std::int64_t updated = 0;
    for_each_in(window, [&](int x, int y) {
      const int bucket = bucket_of(importance(x, y), options_.importance.buckets);
      if (committed(x, y)) {
        ++updated;
        lowest_committed = std::min(lowest_committed, bucket);
      } else {
        highest_left = std::max(highest_left, bucket);
      }
    });
    EXPECT_EQ(updated, pixels);
    EXPECT_GE(lowest_committed, highest_left);
    EXPECT_GT(highest_left, 1) << "the test has nothing to order";
  }

 private:
  static FilterOptions with(double w_coc, double w_rgb, double pixels, int threads) {
    FilterOptions options = options_up_to(60);
    options.importance.order = Order::fearing;
    options.importance.w_coc = w_coc;
    options.importance.w_rgb = w_rgb;
    options.budget = {Budget::Kind::count, pixels};
    options.threads = threads;
    return options;
  }

  FilterOptions options_;
  KernelTable table_{options_.kernel};
  IncrementalFilter filter_;
  Frame before_, after_;
};

// Colours change by anything between 2^-14 and 2^9, CoCs by up to 60 px either way, each on their own.
void change_everything(Frame& frame) {
  std::mt19937 random(12);
  std::uniform_real_distribution<float> exponent(-14, 9), diameter(-60, 60);
  for_each_in(window, [&](int x, int y) {
    const float change = std::exp2(exponent(random));
    frame.colour.set(x, y, static_cast<int>(random() % 3), 0.5f + (random() % 2 ? change : -change));
    frame.depth.at(x, y) = diameter(random);
  });
}

TEST(Importance, TheLargestChangesOfColourComeFirst) {
  for (const int pixels : {1, 100, 3333, 9000}) {
    Selection selection(0, 1, pixels);
    change_everything(selection.after());
    selection.run();
    selection.expect_most_important_first(pixels);
  }
}

TEST(Importance, TheLargestChangesOfCoCComeFirst) {
  for (const int pixels : {1, 100, 3333, 9000}) {
    Selection selection(1, 0, pixels);
    change_everything(selection.after());
    selection.run();
    selection.expect_most_important_first(pixels);
  }
}

TEST(Importance, WeighsBothChanges) {
  for (const double w_rgb : {0.01, 0.5, 30.}) {
    Selection selection(0.5, w_rgb, 2000);
    change_everything(selection.after());
    selection.run();
    selection.expect_most_important_first(2000);
  }
}

TEST(Importance, TiesAreSpreadOverTheImage) {
  const int pixels = 2100;  // a fifth
  Selection selection(0.5, 0.5, pixels);
  selection.after() = flat_frame(window, float32, {0.75f, 0.5f, 0.5f, 1}, 2.f);
  EXPECT_EQ(selection.run().updated, pixels);
  int left = 0, top = 0;
  std::vector<int> of_block(15 * 7);
  for_each_in(window, [&](int x, int y) {
    if (!selection.committed(x, y)) return;
    left += x < 75;
    top += y < 35;
    ++of_block[static_cast<std::size_t>(y / 10 * 15 + x / 10)];
  });
  EXPECT_NEAR(left, pixels / 2, pixels / 10);
  EXPECT_NEAR(top, pixels / 2, pixels / 10);
  for (const int n : of_block) EXPECT_NEAR(n, 20, 19);
}

TEST(Importance, TheSelectionDoesNotDependOnTheThreads) {
  Selection one(0.5, 0.5, 2100, 1), four(0.5, 0.5, 2100, 4);
  for (Selection* selection : {&one, &four}) {
    change_everything(selection->after());
    for_each_in({20, 10, 120, 60}, [&](int x, int y) {  // with many ties
      test::set_colour(selection->after().colour, x, y, {1, 1, 1, 1});
      selection->after().depth.at(x, y) = 9;
    });
    selection->run();
  }
  for_each_in(window, [&](int x, int y) { ASSERT_EQ(one.committed(x, y), four.committed(x, y)); });
}

TEST(Importance, PixelsNeverCommittedComeBeforeAllOthers) {
  FilterOptions options = options_up_to(4);
  options.slice_edges = 1;
  options.budget = {Budget::Kind::count, 200};

  IncrementalFilter filter(window, options);
  int slices_left = 20;
  const std::int64_t committed = filter
                                     .filter(flat_frame(window, float32, {0.5f, 0.5f, 0.5f, 1}, 2.f), coc_as_depth,
                                             [&] { return slices_left-- == 0; })
                                     .updated;
  ASSERT_GT(committed, 500);
  const auto never_committed = [&] {
    return std::count(filter.committed().index.begin(), filter.committed().index.end(), kNeverCommitted);
  };
  const auto before = never_committed();
  ASSERT_GT(before, 500);
  // Every pixel changes as much as a pixel can.
  filter.filter(flat_frame(window, float32, {60000.f, 60000.f, 60000.f, 1}, 2.f), coc_as_depth);
  EXPECT_EQ(before - never_committed(), 200);
}

}  // namespace
}  // namespace pullfocus
