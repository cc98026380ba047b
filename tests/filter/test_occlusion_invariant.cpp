// The invariant with occlusion bitmaps, as properties over random shots.
#include <gtest/gtest.h>

#include "filter/linear_filter.h"
#include "occlusion_twin.h"
#include "random_frames.h"
#include "reference.h"
#include "shapes.h"

namespace pullfocus {
namespace {

using test::RandomShot;

struct Case {
  Window window;
  float largest_px;
  SampleType type;
  bool with_alpha, hostile;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.window.width() << "x" << c.window.height() << " to " << c.largest_px << " px"
             << (c.type == SampleType::half ? " half" : " float") << (c.with_alpha ? " alpha" : "")
             << (c.hostile ? " hostile" : "");
}

FilterOptions options_for(const Case& c, unsigned seed) {
  const std::vector<KernelShape> shapes = test::all_shapes();
  FilterOptions options;
  options.visibility.kind = VisibilityOptions::Kind::bitmap;
  constexpr int sizes[] = {32, 16, 64, 2, 10};
  constexpr double cutoffs[] = {3, 0, 1.25, 8};
  options.visibility.bitmap_size = sizes[seed / 2 % 5];
  options.visibility.cutoff_px = cutoffs[seed % 4];
  options.kernel.shape = shapes[seed % shapes.size()];
  options.kernel.max_coc_px = std::max(1.f, c.largest_px);
  options.output_type = SampleType::float32;
  return options;
}

Budget random_budget(std::mt19937& random) {
  Budget budget;
  switch (std::uniform_int_distribution<int>(0, 4)(random)) {
    case 0:
      return budget;
    case 2:
      budget.kind = Budget::Kind::time;
      budget.amount = std::uniform_int_distribution<int>(1, 40)(random);
      return budget;
    case 1:
      budget.kind = Budget::Kind::count;
      budget.amount = std::uniform_int_distribution<int>(0, 300)(random);
      return budget;
    default:
      budget.amount = std::uniform_int_distribution<int>(1, 100)(random);
      return budget;
  }
}

constexpr Order kOrders[] = {Order::gain, Order::fearing, Order::random};

// Every look at it takes a millisecond, so that time budgets end in repeatable places.
Clock fake_clock() {
  return [ms = 0.]() mutable { return ms += 1; };
}

class InvarianceOfBitmaps : public testing::TestWithParam<Case> {};

TEST_P(InvarianceOfBitmaps, AccumulatorsEqualAScatterOfTheCommittedStateAfterAnyBudgetAndStop) {
  const Case& c = GetParam();
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto kernels = std::make_shared<const KernelTable>(options_for(c, seed).kernel);
    RandomShot shot(c.window, seed, c.type, c.with_alpha, c.hostile);
    if (seed % 3 != 0) shot.use_masks();
    FilterOptions options = options_for(c, seed);
    options.budget = random_budget(shot.random());
    options.slice_edges = 1 + static_cast<std::int64_t>(shot.random()() % 3000);
    options.threads = 1 + static_cast<int>(seed % 4);
    options.importance.order = kOrders[seed % 3];
    options.clock = fake_clock();
    IncrementalFilter filter(c.window, options, kernels);
    CocFunction coc = test::random_lens(shot.random(), c.largest_px);
    for (int frame = 0; frame < 8; ++frame) {
      if (frame > 0) shot.step();
      if (shot.random()() % 2) coc = test::random_lens(shot.random(), c.largest_px);
      int slices_left = static_cast<int>(shot.random()() % 12);
      const bool stoppable = shot.random()() % 2;
      const Stats& stats =
          filter.filter(shot.frame(), coc, stoppable ? StopRequest([&] { return slices_left-- == 0; }) : StopRequest());
      const auto expect_invariant = [&] {
        ASSERT_EQ(stats.changed, stats.updated + stats.left_over);
        ASSERT_EQ(stats.mode == ScatterMode::unchanged, stats.updated == 0);
        const std::vector<std::uint16_t> keys = test::committed_keys(filter);
        const auto expected =
            test::exact_sums_with_bitmaps(filter.committed(), keys, *kernels, options.visibility, filter.lanes());
        for (std::size_t i = 0; i < keys.size(); ++i) {  // what is held out hides nothing
          ASSERT_TRUE(filter.committed().index[i] != kHeldOut || keys[i] == kBackgroundKey);
        }
        ASSERT_TRUE(std::ranges::equal(filter.accumulators(), expected)) << "seed " << seed << ", frame " << frame;
      };
      expect_invariant();
      if (shot.random()() % 3) continue;
      const std::int64_t left = stats.left_over;
      slices_left = static_cast<int>(shot.random()() % 3);
      filter.refine(stoppable ? StopRequest([&] { return slices_left-- == 0; }) : StopRequest());
      ASSERT_EQ(stats.changed, left);
      expect_invariant();
    }
  }
}

TEST_P(InvarianceOfBitmaps, IncrementalEqualsLinearBitForBitWheneverNothingIsLeftOver) {
  const Case& c = GetParam();
  for (unsigned seed = 11; seed <= 20; ++seed) {
    const auto kernels = std::make_shared<const KernelTable>(options_for(c, seed).kernel);
    RandomShot shot(c.window, seed, c.type, c.with_alpha, c.hostile);
    if (seed % 3 != 0) shot.use_masks();
    FilterOptions options = options_for(c, seed);
    options.threads = 1;
    LinearFilter linear(c.window, options, kernels);
    options.threads = 1 + static_cast<int>(seed % 4);
    options.slice_edges = 500;
    IncrementalFilter incremental(c.window, options, kernels);
    CocFunction coc = test::random_lens(shot.random(), c.largest_px);
    for (int frame = 0; frame < 8; ++frame) {
      if (frame > 0) shot.step();
      if (shot.random()() % 3 == 0) coc = test::random_lens(shot.random(), c.largest_px);
      if (shot.random()() % 3 == 0) incremental.filter(shot.frame(), coc, [] { return true; });
      if (shot.random()() % 2) {
        int slices = static_cast<int>(shot.random()() % 5);
        incremental.filter(shot.frame(), coc, [&] { return slices-- == 0; });
        incremental.refine();
      } else {
        ASSERT_EQ(incremental.filter(shot.frame(), coc).left_over, 0);
      }
      linear.filter(shot.frame(), coc);
      ASSERT_EQ(test::difference(incremental.result(), linear.result()), "") << "seed " << seed << " frame " << frame;
      ASSERT_EQ(incremental.result_window(), linear.result_window());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shots, InvarianceOfBitmaps,
                         testing::Values(Case{{0, 0, 1, 1}, 20, SampleType::float32, true, true},
                                         Case{{0, 0, 1, 7}, 40, SampleType::half, false, true},
                                         Case{{0, 0, 9, 1}, 60, SampleType::float32, true, false},
                                         Case{{-3, 5, 2, 8}, 100, SampleType::half, true, true},
                                         Case{{0, 0, 17, 13}, 12, SampleType::half, false, false},
                                         Case{{10, -20, 73, 19}, 8, SampleType::float32, true, true},
                                         Case{{0, 0, 64, 16}, 25, SampleType::half, true, false},
                                         Case{{0, 0, 65, 33}, 30, SampleType::float32, false, true},
                                         Case{{0, 0, 131, 70}, 14, SampleType::half, true, true}));

}  // namespace
}  // namespace pullfocus
