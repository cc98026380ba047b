// The invariant of DESIGN section 5, and the promise that follows from it, as properties over random shots.
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
  bool with_bitmaps = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.window.width() << "x" << c.window.height() << " to " << c.largest_px << " px"
             << (c.type == SampleType::half ? " half" : " float") << (c.with_alpha ? " alpha" : "")
             << (c.hostile ? " hostile" : "") << (c.with_bitmaps ? " bitmaps" : "");
}

FilterOptions options_for(const Case& c, unsigned seed) {
  const std::vector<KernelShape> shapes = test::all_shapes();
  FilterOptions options;
  options.kernel.shape = shapes[seed % shapes.size()];
  options.kernel.max_coc_px = std::max(1.f, c.largest_px);
  options.output_type = SampleType::float32;
  if (c.with_bitmaps) {
    constexpr int sizes[] = {32, 16, 64, 2, 10};
    constexpr double cutoffs[] = {3, 0, 1.25, 8};
    options.visibility = {VisibilityOptions::Kind::bitmap, {}, sizes[seed / 2 % 5], cutoffs[seed % 4]};
    return options;
  }
  switch (seed % 3) {
    case 0:
      options.visibility.kind = VisibilityOptions::Kind::none;
      break;
    case 1:
      break;  // near, focus, far
    default:
      options.visibility.borders = {-6, -2, 0, 0.5, 8};
  }
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

void expect_invariant(const IncrementalFilter& filter, const KernelTable& kernels,
                      const VisibilityOptions& visibility) {
  if (visibility.kind != VisibilityOptions::Kind::bitmap) {
    ASSERT_TRUE(test::invariant_holds(filter, kernels));
    return;
  }
  const std::vector<std::uint16_t> keys = test::committed_keys(filter);
  for (std::size_t i = 0; i < keys.size(); ++i) {  // what is held out hides nothing
    ASSERT_TRUE(filter.committed().index[i] != kHeldOut || keys[i] == kBackgroundKey);
  }
  ASSERT_TRUE(std::ranges::equal(filter.accumulators(), test::exact_sums_with_bitmaps(filter.committed(), keys, kernels,
                                                                                      visibility, filter.lanes())));
}

class Invariant : public testing::TestWithParam<Case> {};

TEST_P(Invariant, AccumulatorsEqualAScatterOfTheCommittedStateAfterAnyBudgetAndStop) {
  const Case& c = GetParam();
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto kernels = std::make_shared<const KernelTable>(options_for(c, seed).kernel);
    RandomShot shot(c.window, seed, c.type, c.with_alpha, c.hostile);
    if (seed / 3 % 2 == 1) shot.use_masks();  // with every visibility
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
      const auto check = [&] {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", frame " << frame);
        ASSERT_EQ(stats.changed, stats.updated + stats.left_over);
        ASSERT_EQ(stats.mode == ScatterMode::unchanged, stats.updated == 0);
        ASSERT_NO_FATAL_FAILURE(expect_invariant(filter, *kernels, options.visibility));
      };
      ASSERT_NO_FATAL_FAILURE(check());
      if (shot.random()() % 3) continue;
      const std::int64_t left = stats.left_over;
      slices_left = static_cast<int>(shot.random()() % 3);
      filter.refine(stoppable ? StopRequest([&] { return slices_left-- == 0; }) : StopRequest());
      ASSERT_EQ(stats.changed, left);
      ASSERT_NO_FATAL_FAILURE(check());
    }
  }
}

TEST_P(Invariant, IncrementalEqualsLinearBitForBitWheneverNothingIsLeftOver) {
  const Case& c = GetParam();
  for (unsigned seed = 11; seed <= 20; ++seed) {
    const auto kernels = std::make_shared<const KernelTable>(options_for(c, seed).kernel);
    RandomShot shot(c.window, seed, c.type, c.with_alpha, c.hostile);
    if (seed / 3 % 2 == 1) shot.use_masks();  // with every visibility
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

std::vector<Case> cases(bool with_bitmaps) {
  std::vector<Case> all{
      {{0, 0, 1, 1}, 20, SampleType::float32, true, true},  {{0, 0, 1, 7}, 40, SampleType::half, false, true},
      {{0, 0, 9, 1}, 60, SampleType::float32, true, false}, {{-3, 5, 2, 8}, 100, SampleType::half, true, true},
      {{0, 0, 17, 13}, 12, SampleType::half, false, false}, {{10, -20, 73, 19}, 8, SampleType::float32, true, true},
      {{0, 0, 64, 16}, 25, SampleType::half, true, false},  {{0, 0, 65, 33}, 30, SampleType::float32, false, true},
      {{0, 0, 131, 70}, 14, SampleType::half, true, true}};
  for (Case& c : all) c.with_bitmaps = with_bitmaps;
  return all;
}

INSTANTIATE_TEST_SUITE_P(Shots, Invariant, testing::ValuesIn(cases(false)));
INSTANTIATE_TEST_SUITE_P(ShotsWithBitmaps, Invariant, testing::ValuesIn(cases(true)));

class OrderOf : public testing::TestWithParam<Order> {};

TEST_P(OrderOf, PicksTheSamePixelsWithAnyNumberOfThreads) {
  const Window window{0, 0, 150, 90};
  FilterOptions options;
  options.kernel.max_coc_px = 30;
  options.budget.amount = 37;
  options.importance.order = GetParam();
  RandomShot shot(window, 5, SampleType::half, true, true);
  shot.use_masks();
  std::vector<std::unique_ptr<IncrementalFilter>> filters;
  for (const int threads : {1, 2, 3, 4}) {
    options.threads = threads;
    filters.push_back(std::make_unique<IncrementalFilter>(window, options));
  }
  for (int frame = 0; frame < 10; ++frame) {
    if (frame > 0) shot.step();
    const CocFunction coc = test::random_lens(shot.random(), 30);
    const Stats first = filters[0]->filter(shot.frame(), coc);
    for (std::size_t f = 1; f < filters.size(); ++f) {
      const Stats stats = filters[f]->filter(shot.frame(), coc);
      ASSERT_EQ(stats.edges, first.edges);
      ASSERT_EQ(stats.updated, first.updated);
      ASSERT_EQ(stats.resolved, first.resolved);
      ASSERT_EQ(test::difference(filters[f]->result(), filters[0]->result()), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Invariance, OrderOf, testing::ValuesIn(kOrders),
                         [](const auto& order) { return std::string(name(order.param)); });

TEST(Invariance, AFilterThatMeetsHalfAndFloatFramesEqualsLinear) {
  const Window window{0, 0, 40, 25};
  FilterOptions options;
  options.kernel.max_coc_px = 16;
  options.kernel.max_radiance = 100.03f;  // not a half: must mean the same for both types
  options.output_type = SampleType::half;
  RandomShot shot(window, 3, SampleType::half, true, true);
  shot.use_masks();
  IncrementalFilter incremental(window, options);
  LinearFilter linear(window, options);
  const CocFunction coc = test::random_lens(shot.random(), 16);
  for (const SampleType type : {SampleType::half, SampleType::float32, SampleType::half, SampleType::float32}) {
    shot.use_type(type);
    shot.step();
    incremental.filter(shot.frame(), coc);
    linear.filter(shot.frame(), coc);
    ASSERT_EQ(test::difference(incremental.result(), linear.result()), "");
  }
}

TEST(Invariance, ResetForgetsTheShot) {
  const Window window{0, 0, 30, 30};
  FilterOptions options;
  options.kernel.max_coc_px = 10;
  RandomShot shot(window, 8, SampleType::half, true, false);
  IncrementalFilter used(window, options), fresh(window, options);
  const CocFunction coc = test::random_lens(shot.random(), 10);
  used.filter(shot.frame(), coc);
  used.reset();
  shot.step();
  const Stats after_reset = used.filter(shot.frame(), coc);
  EXPECT_EQ(after_reset.updated, 900);
  fresh.filter(shot.frame(), coc);
  EXPECT_EQ(test::difference(used.result(), fresh.result()), "");
}

}  // namespace
}  // namespace pullfocus
