// Sums that a rebuild did not keep: made from the committed state when they are needed, and never seen to be missing.
#include <gtest/gtest.h>

#include "filter/linear_filter.h"
#include "occlusion_twin.h"
#include "random_frames.h"
#include "reference.h"
#include "shapes.h"

namespace pullfocus {
namespace {

using test::RandomShot;

constexpr auto half = SampleType::half;

// A shot that changes throughout most of the time, so that sums are mostly not kept.
class RestlessShot {
 public:
  RestlessShot(const Window& window, unsigned seed)
      : shot_(window, seed, seed % 2 ? half : SampleType::float32, seed % 3 == 0, seed % 4 < 2), coc_(lens()) {
    if (seed % 5 == 0) shot_.use_masks();
  }

  std::mt19937& random() { return shot_.random(); }
  const Frame& frame() const { return noisy_; }
  const CocFunction& coc() const { return coc_; }

  void step() {
    const auto what = random()() % 8;
    if (what == 0) return;  // unchanged
    if (what == 1) coc_ = lens();
    if (what == 2) shot_.use_type(random()() % 2 ? half : SampleType::float32);
    if (what < 4) {
      shot_.step();
      noisy_ = shot_.frame();
      return;
    }
    noisy_ = shot_.frame();
    const Window& w = noisy_.window();
    const float gain = 0.5f + static_cast<float>(random()() % 64) / 64;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        for (int c = 0; c < 3; ++c) noisy_.colour.set(x, y, c, gain * noisy_.colour.get(x, y, c));
      }
    }
  }

 private:
  CocFunction lens() { return test::random_lens(shot_.random(), 24); }

  RandomShot shot_;
  Frame noisy_ = shot_.frame();
  CocFunction coc_;
};

FilterOptions options_for(unsigned seed) {
  FilterOptions options;
  const std::vector<KernelShape> shapes = test::all_shapes();
  options.kernel.shape = shapes[seed % shapes.size()];
  options.kernel.max_coc_px = 24;
  options.threads = 1 + static_cast<int>(seed % 4);
  options.slice_edges = 2000;
  switch (seed % 4) {
    case 0:
      options.visibility.kind = VisibilityOptions::Kind::none;
      break;
    case 1:
      options.visibility = {VisibilityOptions::Kind::bitmap, {}, 16, 1.25};
      break;
    case 2:
      options.visibility.borders = {-6, -2, 0, 0.5, 8};
      break;
    default:
      break;
  }
  return options;
}

void expect_invariant(const IncrementalFilter& filter, const KernelTable& kernels, const FilterOptions& options) {
  if (options.visibility.kind != VisibilityOptions::Kind::bitmap) {
    ASSERT_TRUE(test::invariant_holds(filter, kernels));
    return;
  }
  ASSERT_TRUE(std::ranges::equal(
      filter.accumulators(), test::exact_sums_with_bitmaps(filter.committed(), test::committed_keys(filter), kernels,
                                                           options.visibility, filter.lanes())));
}

constexpr Window windows[] = {{0, 0, 40, 25}, {-3, 5, 128, 37}, {0, 0, 131, 33}, {7, 7, 8, 60}};

TEST(SumsOnDemand, EqualAScatterOfTheCommittedStateAfterAnyHistoryOfFullAndSmallChangesStopsRefinesAndResets) {
  int without = 0, made = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const FilterOptions options = options_for(seed);
    const Window& window = windows[seed % 4];
    const auto kernels = std::make_shared<const KernelTable>(options.kernel);
    FilterOptions some = options;
    if (seed % 6 == 5) some.budget.amount = 85;  // enough for rebuilds
    IncrementalFilter filter(window, some, kernels);
    LinearFilter linear(window, options, kernels);
    RestlessShot shot(window, seed);
    for (int frame = 0; frame < 24; ++frame) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", frame " << frame);
      if (frame > 0) shot.step();
      const bool kept = filter.keeps_sums();
      const auto how = shot.random()() % 16;
      if (how == 0) {
        filter.reset();
        ASSERT_TRUE(filter.keeps_sums());
      }
      int slices = static_cast<int>(shot.random()() % 4);
      const StopRequest stop = how == 1 ? StopRequest([&] { return slices-- == 0; }) : StopRequest();
      const Stats stats = filter.filter(shot.frame(), shot.coc(), stop);
      ASSERT_EQ(stats.changed, stats.updated + stats.left_over);
      ASSERT_EQ(stats.mode == ScatterMode::unchanged, stats.updated == 0);
      ASSERT_TRUE(filter.keeps_sums() || stats.mode != ScatterMode::incremental);
      without += !filter.keeps_sums();
      made += !kept && filter.keeps_sums() && how != 0;
      // Not after every frame: what is read here must not be what keeps the sums right.
      if (shot.random()() % 2) {
        ASSERT_NO_FATAL_FAILURE(expect_invariant(filter, *kernels, options));
      }
      if (how == 2) filter.refine();
      if (how != 2 && stats.left_over > 0) continue;
      linear.filter(shot.frame(), shot.coc());
      ASSERT_EQ(test::difference(filter.result(), linear.result()), "");
    }
    ASSERT_NO_FATAL_FAILURE(expect_invariant(filter, *kernels, options));
  }
  EXPECT_GT(without, 60);
  EXPECT_GT(made, 20);
}

TEST(SumsOnDemand, ModeAndCountsAreThoseOfAFilterThatAlwaysKeepsItsSums) {
  int differ = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    FilterOptions options = options_for(seed);
    const Window& window = windows[seed % 4];
    const auto kernels = std::make_shared<const KernelTable>(options.kernel);
    if (seed % 3 == 0) options.thresholds.rgb = 0.1;
    IncrementalFilter filter(window, options, kernels);
    options.budget = {Budget::Kind::time, 1e8};  // under a time budget sums are kept
    options.clock = [] { return 0.; };
    IncrementalFilter keeping(window, options, kernels);
    RestlessShot shot(window, seed);
    for (int frame = 0; frame < 24; ++frame) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", frame " << frame);
      if (frame > 0) shot.step();
      const Stats stats = filter.filter(shot.frame(), shot.coc());
      const Stats& expected = keeping.filter(shot.frame(), shot.coc());
      ASSERT_EQ(stats.mode, expected.mode);
      ASSERT_EQ(stats.changed, expected.changed);
      ASSERT_EQ(stats.updated, expected.updated);
      ASSERT_EQ(stats.left_over, 0);
      ASSERT_EQ(stats.repaired_colour, expected.repaired_colour);
      ASSERT_EQ(stats.clamped_radiance, expected.clamped_radiance);
      ASSERT_EQ(filter.result_window(), keeping.result_window());
      ASSERT_EQ(test::difference(filter.result(), keeping.result()), "");
      differ += filter.keeps_sums() != keeping.keeps_sums();
    }
  }
  EXPECT_GT(differ, 60);
}

}  // namespace
}  // namespace pullfocus
