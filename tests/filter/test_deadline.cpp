// Time budgets, stopping from another thread, and refining to the exact result.
#include <gtest/gtest.h>

#include <atomic>
#include <stop_token>
#include <thread>

#include "camera/usage.h"
#include "filter/incremental_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::options_up_to;

const Window window{0, 0, 300, 120};

// A clock that the test moves: a look at it takes `ms`.
struct FakeClock {
  double now = 0, ms = 0;
  int looks = 0;
  Clock clock() {
    return [this] {
      ++looks;
      return now += ms;
    };
  }
};

FilterOptions with_time(double ms, FakeClock& clock) {
  FilterOptions options = options_up_to(20);
  options.budget = {Budget::Kind::time, ms};
  options.clock = clock.clock();
  options.slice_edges = 2000;
  return options;
}

ColourImage linear_result(const Frame& frame, const CocFunction& coc) {
  const auto linear = make_linear_filter(window, options_up_to(20));
  linear->filter(frame, coc);
  return linear->result();
}

TEST(TimeBudget, WithTimeInPlentyDoesEverything) {
  FakeClock clock;
  test::RandomShot shot(window, 1, SampleType::half, true, false);
  IncrementalFilter filter(window, with_time(1e6, clock));
  for (int frame = 0; frame < 4; ++frame) {
    if (frame > 0) shot.step();
    const CocFunction coc = test::random_lens(shot.random(), 20);
    const Stats& stats = filter.filter(shot.frame(), coc);
    EXPECT_EQ(stats.left_over, 0);
    EXPECT_EQ(stats.overshoot_ms, 0);
    EXPECT_EQ(test::difference(filter.result(), linear_result(shot.frame(), coc)), "");
  }
}

TEST(TimeBudget, EndsAtTheFirstSliceBorderBeyondIt) {
  FakeClock clock;
  test::RandomShot shot(window, 2, SampleType::half, true, false);
  // Forty looks, and less than a rebuild is expected to take.
  IncrementalFilter filter(window, with_time(1, clock));
  clock.ms = 1. / 40;
  const Stats& stats = filter.filter(shot.frame(), test::random_lens(shot.random(), 20));
  EXPECT_GT(stats.left_over, 0);
  EXPECT_GT(stats.slices, 5);
  EXPECT_LE(stats.slices, 40);
  // Looks: at the beginning, once or twice before the slices, after each of them, and two at the end.
  EXPECT_LE(clock.looks, stats.slices + 6);
  EXPECT_LE(stats.overshoot_ms, 3. / 40);
}

TEST(TimeBudget, DoesASliceHoweverShortTheTimeSoThatCallsGetThere) {
  FakeClock clock;
  clock.ms = 100;
  test::RandomShot shot(window, 3, SampleType::half, true, false);
  IncrementalFilter filter(window, with_time(1, clock));
  const CocFunction coc = test::random_lens(shot.random(), 20);
  const Stats& stats = filter.filter(shot.frame(), coc);
  EXPECT_EQ(stats.slices, 1);
  EXPECT_GT(stats.updated, 0);
  EXPECT_GT(stats.overshoot_ms, 99);
  int calls = 0;
  while (stats.left_over > 0 && ++calls < 10000) filter.refine();
  EXPECT_EQ(stats.left_over, 0);
  EXPECT_GT(calls, 10);
  EXPECT_EQ(test::difference(filter.result(), linear_result(shot.frame(), coc)), "");
}

TEST(TimeBudget, ResolvesOnlyWhatItsSlicesReachWhileMostPixelsHaveNeverBeenCommitted) {
  FakeClock clock;
  clock.ms = 100;
  test::RandomShot shot(window, 3, SampleType::half, true, false);
  IncrementalFilter filter(window, with_time(1, clock));
  filter.filter(shot.frame(), test::random_lens(shot.random(), 20));
  for (int call = 0; call < 3; ++call) {
    const Stats& stats = filter.refine();
    ASSERT_GT(stats.left_over, 30000);
    EXPECT_GT(stats.resolved, 0);
    EXPECT_LT(stats.resolved, 12000);
  }
}

TEST(TimeBudget, KeepsBackTheTimeThatResolvingTook) {
  FakeClock clock;
  test::RandomShot shot(window, 4, SampleType::half, true, false);
  IncrementalFilter filter(window, with_time(30, clock));
  clock.ms = 1;
  // Learns that to resolve this picture takes a look's time, 1 ms, so of 30 ms about 28 are left for slices.
  CocFunction coc = test::random_lens(shot.random(), 20);
  filter.filter(shot.frame(), coc);
  for (int i = 0; i < 20; ++i) filter.refine();
  shot.step();
  EXPECT_LE(filter.filter(shot.frame(), coc).overshoot_ms, 1);
}

TEST(TimeBudget, ServesWhatHasWaitedLongestInEverySecondSlice) {
  FakeClock clock;
  clock.ms = 1;
  IncrementalFilter filter(window, with_time(8, clock));
  Frame frame = test::flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 6);
  clock.ms = 0;
  filter.filter(frame, coc_as_depth);
  clock.ms = 1;
  // A faint change everywhere, and from then on a strong one in the left half in every frame: more than the budget.
  test::for_each_in(window, [&](int x, int y) { frame.colour.set(x, y, 0, 0.501f); });
  for (int i = 0; i < 400; ++i) {
    test::for_each_in({0, 0, 150, 120}, [&](int x, int y) { frame.colour.set(x, y, 1, i % 2 ? 9.f : 0.f); });
    filter.filter(frame, coc_as_depth);
  }
  test::for_each_in(window,
                    [&](int x, int y) { ASSERT_EQ(filter.committed().colour.get(x, y, 0), 0.501f) << x << "," << y; });
}

TEST(TimeBudget, RebuildsOnlyIfThatEndsInTime) {
  FakeClock clock;
  test::RandomShot shot(window, 5, SampleType::half, true, false);
  const CocFunction a = test::random_lens(shot.random(), 20), b = test::random_lens(shot.random(), 20);
  IncrementalFilter filter(window, with_time(1e6, clock));
  EXPECT_EQ(filter.filter(shot.frame(), a).mode, ScatterMode::rebuild);
  IncrementalFilter hurried(window, with_time(1e-3, clock));
  EXPECT_EQ(hurried.filter(shot.frame(), a).mode, ScatterMode::incremental);
  EXPECT_EQ(filter.filter(shot.frame(), b).left_over, 0);
}

TEST(Refine, EndsWhereAFullCallWouldWhateverTheBudget) {
  for (const Budget& budget :
       {Budget{Budget::Kind::percent, 5}, Budget{Budget::Kind::count, 100}, Budget{Budget::Kind::count, 0}}) {
    test::RandomShot shot(window, 6, SampleType::half, true, true);
    FilterOptions options = options_up_to(20);
    options.budget = budget;
    IncrementalFilter filter(window, options);
    for (int frame = 0; frame < 4; ++frame) {
      if (frame > 0) shot.step();
      const CocFunction coc = test::random_lens(shot.random(), 20);
      const std::int64_t left = filter.filter(shot.frame(), coc).left_over;
      const Stats& stats = filter.refine();
      EXPECT_EQ(stats.changed, left);
      EXPECT_EQ(stats.left_over, 0);
      EXPECT_EQ(test::difference(filter.result(), linear_result(shot.frame(), coc)), "");
    }
  }
}

TEST(Refine, WithNothingLeftOverDoesNothing) {
  test::RandomShot shot(window, 7, SampleType::half, true, false);
  const auto filter = make_incremental_filter(window, options_up_to(20));
  EXPECT_EQ(filter->refine().updated, 0);
  filter->filter(shot.frame(), coc_as_depth);
  const ColourImage before = filter->result();
  EXPECT_EQ(filter->refine().mode, ScatterMode::unchanged);
  EXPECT_EQ(filter->result(), before);
  filter->reset();
  EXPECT_EQ(filter->refine().changed, 0);
  const auto linear = make_linear_filter(window, options_up_to(20));
  linear->filter(shot.frame(), coc_as_depth);
  EXPECT_EQ(linear->refine().updated, 0);
}

TEST(StopToken, FromAnotherThreadEndsTheCallAtTheNextSliceAndRefiningEndsWhereAFullCallWould) {
  test::RandomShot shot(window, 8, SampleType::half, true, false);
  FilterOptions options = options_up_to(20);
  options.slice_edges = 1;
  IncrementalFilter filter(window, options);
  const CocFunction coc = test::random_lens(shot.random(), 20);
  std::stop_source source;
  std::atomic<bool> begun = false;
  std::jthread other([&] {
    begun.wait(false);
    source.request_stop();
  });
  bool stop_was_seen = false;
  const StopRequest stop = [&] {
    if (!begun.exchange(true)) {
      begun.notify_one();
      other.join();
    }
    return stop_was_seen = source.get_token().stop_requested();
  };
  const Stats& stats = filter.filter(shot.frame(), coc, stop);
  EXPECT_TRUE(stop_was_seen);
  EXPECT_EQ(stats.slices, 0);
  EXPECT_GT(stats.left_over, 0);
  filter.refine();
  EXPECT_EQ(stats.left_over, 0);
  EXPECT_EQ(test::difference(filter.result(), linear_result(shot.frame(), coc)), "");
}

}  // namespace
}  // namespace pullfocus
