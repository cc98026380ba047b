// Budgets, interruption, and the counters that report them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "camera/usage.h"
#include "filter/incremental_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

constexpr auto half = SampleType::half;
const Window window{0, 0, 150, 70};

Budget percent(double amount) { return {Budget::Kind::percent, amount}; }
Budget count(double amount) { return {Budget::Kind::count, amount}; }

TEST(BudgetText, IsAPercentageOrANumberOfPixels) {
  const auto expect = [](const char* text, const Budget& budget) {
    EXPECT_EQ(Budget::parse(text).kind, budget.kind) << text;
    EXPECT_EQ(Budget::parse(text).amount, budget.amount) << text;
  };
  expect("15%", percent(15));
  expect("100%", percent(100));
  expect("0.5%", percent(0.5));
  expect("200000", count(200000));
  expect("0", count(0));
  expect("1e6", count(1e6));
}

TEST(BudgetText, ThatMeansNeitherIsRefusedByName) {
  for (const char* text :
       {"",    "%",   "0%",   "-1%", "100.1%", "101%",  "nan%",  "inf%", "15 %", " 15%",  "15%%", "1.5", "-1",
        "nan", "inf", "1e15", "0ms", "-1ms",   "nanms", "40 ms", "40s",  "0x10", "1,000", "12px", "+5",  "all"}) {
    expect_usage_error([&] { Budget::parse(text); }, "--budget");
    expect_usage_error([&] { Budget::parse(text); }, std::string("'") + text + "'");
  }
}

TEST(BudgetPixels, OfAPercentageAreRoundedUpSoThatTheLastOneIsServed) {
  EXPECT_EQ(percent(100).pixels(12345), 12345);
  EXPECT_EQ(percent(50).pixels(11), 6);
  EXPECT_EQ(percent(1).pixels(1), 1);
  EXPECT_EQ(percent(1e-9).pixels(1000), 1);
  EXPECT_EQ(percent(25).pixels(400), 100);
  EXPECT_EQ(percent(30).pixels(0), 0);
}

TEST(BudgetPixels, OfACountAreNeverMoreThanChanged) {
  EXPECT_EQ(count(0).pixels(10), 0);
  EXPECT_EQ(count(7).pixels(10), 7);
  EXPECT_EQ(count(10).pixels(10), 10);
  EXPECT_EQ(count(1e14).pixels(10), 10);
}

TEST(Options, OutOfRangeAreRefusedByName) {
  const auto refuses = [](auto&& change, const char* name) {
    FilterOptions options = options_up_to(2);
    change(options);
    expect_usage_error([&] { make_incremental_filter({0, 0, 4, 4}, options); }, name);
    expect_usage_error([&] { make_linear_filter({0, 0, 4, 4}, options); }, name);
  };
  for (const double bad : {-1., -1e-9, std::numeric_limits<double>::infinity(), std::nan("")}) {
    refuses([&](FilterOptions& o) { o.importance.w_coc = bad; }, "--w-coc");
    refuses([&](FilterOptions& o) { o.importance.w_rgb = bad; }, "--w-rgb");
  }
  for (const int bad : {-1, 1025}) refuses([&](FilterOptions& o) { o.threads = bad; }, "--threads");
  for (const double bad : {0., -5., 100.01, std::nan("")}) {
    refuses([&](FilterOptions& o) { o.budget = percent(bad); }, "--budget");
  }
  for (const double bad : {-1., std::nan("")}) refuses([&](FilterOptions& o) { o.budget = count(bad); }, "--budget");
  refuses([](FilterOptions& o) { o.slice_edges = 0; }, "slice_edges");
  refuses([](FilterOptions& o) { o.kernel.max_coc_px = 501; }, "--max-coc");
}

TEST(BudgetedFilter, UpdatesExactlyWhatTheBudgetAllows) {
  for (const Budget& budget : {percent(100), percent(33), percent(1), count(0), count(1), count(999), count(1e9)}) {
    FilterOptions options = options_up_to(12);
    options.budget = budget;
    test::RandomShot shot(window, 3, half, true, true);
    IncrementalFilter filter(window, options);
    const CocFunction coc = test::random_lens(shot.random(), 12);
    filter.filter(shot.frame(), coc);
    for (int frame = 0; frame < 8; ++frame) {
      const ColourImage before = filter.committed().colour;
      const auto index_before = filter.committed().index;
      const Stats& stats = filter.filter(shot.step(), coc);
      ASSERT_EQ(stats.updated, budget.pixels(stats.changed));
      ASSERT_EQ(stats.changed, stats.updated + stats.left_over);
      std::int64_t committed = 0;
      std::size_t i = 0;
      for_each_in(window, [&](int x, int y) {
        const bool recoloured = std::memcmp(before.pixel(x, y), filter.committed().colour.pixel(x, y), 8) != 0;
        committed += recoloured || index_before[i] != filter.committed().index[i];
        ++i;
      });
      ASSERT_EQ(committed, stats.updated);
    }
  }
}

TEST(BudgetedFilter, DoesItsFirstFrameInFull) {
  for (const Budget& budget : {percent(1), count(0), count(5)}) {
    FilterOptions options = options_up_to(12);
    test::RandomShot shot(window, 5, half, true, false);
    const CocFunction coc = test::random_lens(shot.random(), 12);
    const auto linear = make_linear_filter(window, options);
    options.budget = budget;
    const auto filter = make_incremental_filter(window, options);
    const Stats& stats = filter->filter(shot.frame(), coc);
    EXPECT_EQ(stats.changed, 150 * 70);
    EXPECT_EQ(stats.left_over, 0);
    linear->filter(shot.frame(), coc);
    EXPECT_EQ(test::difference(filter->result(), linear->result()), "");
  }
}

TEST(BudgetedFilter, OfNothingKeepsThePicture) {
  FilterOptions options = options_up_to(12);
  options.budget = count(0);
  test::RandomShot shot(window, 6, half, true, false);
  const CocFunction coc = test::random_lens(shot.random(), 12);
  const auto filter = make_incremental_filter(window, options);
  filter->filter(shot.frame(), coc);
  const ColourImage before = filter->result();
  for (int frame = 0; frame < 6; ++frame) {
    const Stats& stats = filter->filter(shot.step(), coc);
    EXPECT_EQ(stats.mode, ScatterMode::unchanged);
    EXPECT_EQ(stats.updated, 0);
    EXPECT_EQ(stats.edges, 0);
    EXPECT_EQ(stats.resolved, 0);
    EXPECT_EQ(test::difference(filter->result(), before), "");
  }
}

TEST(BudgetedFilter, DrainsWhatWasLeftOverAndThenEqualsLinear) {
  for (const Budget& budget : {percent(30), count(700)}) {
    FilterOptions options = options_up_to(12);
    test::RandomShot shot(window, 7, half, true, true);
    const CocFunction coc = test::random_lens(shot.random(), 12);
    const auto linear = make_linear_filter(window, options);
    options.budget = budget;
    const auto filter = make_incremental_filter(window, options);
    filter->filter(shot.frame(), coc);
    for (int i = 0; i < 5; ++i) filter->filter(shot.step(), coc);
    std::int64_t left_over = filter->filter(shot.frame(), coc).left_over;
    int calls = 0;
    while (left_over > 0) {
      const Stats& stats = filter->filter(shot.frame(), coc);
      ASSERT_EQ(stats.changed, left_over);
      ASSERT_LT(stats.left_over, left_over);
      left_over = stats.left_over;
      ASSERT_LT(++calls, 60);
    }
    EXPECT_GT(calls, 1);
    linear->filter(shot.frame(), coc);
    EXPECT_EQ(test::difference(filter->result(), linear->result()), "");
    EXPECT_EQ(filter->filter(shot.frame(), coc).mode, ScatterMode::unchanged);
  }
}

TEST(Interruption, BeforeTheFirstSliceShowsTheInput) {
  FilterOptions options;
  options.kernel.max_coc_px = 20;
  test::RandomShot shot(window, 8, half, true, false);
  const auto filter = make_incremental_filter(window, options);
  const Stats& stats = filter->filter(shot.frame(), test::random_lens(shot.random(), 20), [] { return true; });
  EXPECT_EQ(stats.mode, ScatterMode::unchanged);
  EXPECT_EQ(stats.updated, 0);
  EXPECT_EQ(stats.left_over, 150 * 70);
  EXPECT_EQ(test::difference(filter->result(), shot.frame().colour), "");
}

TEST(Interruption, IsAskedForAtEverySliceBorderAndObeyedAtOnce) {
  FilterOptions options = options_up_to(20);
  options.slice_edges = 1;  // every row of a tile is a slice
  test::RandomShot shot(window, 9, half, true, false);
  const CocFunction coc = test::random_lens(shot.random(), 20);
  int asked = 0;
  const auto whole = make_incremental_filter(window, options);
  whole->filter(shot.frame(), coc, [&] { return ++asked, false; });
  EXPECT_EQ(asked, 3 * 70);
  const auto linear = make_linear_filter(window, options);
  linear->filter(shot.frame(), coc);
  EXPECT_EQ(test::difference(whole->result(), linear->result()), "");

  const auto stopped = make_incremental_filter(window, options);
  int left = 1;
  EXPECT_LE(stopped->filter(shot.frame(), coc, [&] { return left-- == 0; }).updated, 64);
  EXPECT_EQ(left, -1) << "asked again after it said stop";
}

TEST(Interruption, ShowsTheInputWhereNothingWasCommittedAndTheFilteredPictureElsewhere) {
  FilterOptions options = options_up_to(20);
  options.slice_edges = 1;
  test::RandomShot shot(window, 10, half, true, false);
  const CocFunction coc = test::random_lens(shot.random(), 20);
  IncrementalFilter filter(window, options);
  int slices_left = 60;
  filter.filter(shot.frame(), coc, [&] { return slices_left-- == 0; });
  std::size_t i = 0;
  int differ = 0;
  for_each_in(window, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      const bool same = filter.result().get(x, y, c) == shot.frame().colour.get(x, y, c);
      if (filter.committed().index[i] == kNeverCommitted) {
        ASSERT_TRUE(same) << x << "," << y;
      } else {
        differ += !same;
      }
    }
    ++i;
  });
  EXPECT_GT(differ, 1000);
}

}  // namespace
}  // namespace pullfocus
