// Depths that are only compared while their indices are known: never seen but in time.
#include <gtest/gtest.h>

#include <cmath>

#include "filter/linear_filter.h"
#include "importance/remembered_depths.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

constexpr float kLargest = 24;

struct Case {
  FilterOptions options;
  bool masks, hostile;
};

Case case_for(unsigned seed) {
  Case c{{}, seed % 5 == 0, seed % 3 == 0};
  c.options.kernel.max_coc_px = seed % 2 ? kLargest : kLargest / 2;
  c.options.threads = 1 + static_cast<int>(seed % 3);
  if (seed % 4 == 1) c.options.visibility.kind = VisibilityOptions::Kind::none;
  if (seed % 4 == 2) c.options.visibility = {VisibilityOptions::Kind::bitmap, {}, 16, 1.25};
  if (seed % 7 == 3) c.options.thresholds.rgb = 0.1;
  if (seed % 7 == 4) c.options.thresholds.coc_px = 2;
  return c;
}

// Frames of a still camera in which a little moves, often back to where it was, or stays within the same index.
class StillShot {
 public:
  StillShot(const Window& window, unsigned seed, const Case& c)
      : shot_(window, seed, SampleType::half, seed % 2, c.hostile), coc_(lens()) {
    if (c.masks) shot_.use_masks();
    frame_ = before_ = with_empty_border(shot_.frame());
  }

  std::mt19937& random() { return shot_.random(); }
  const Frame& frame() const { return frame_; }
  const CocFunction& coc() const { return coc_; }

  void step() {
    switch (random()() % 10) {
      case 0:
        coc_ = lens();
        break;
      case 1:
        before_ = frame_;
        frame_ = with_empty_border(shot_.step());
        break;
      case 2:
      case 3:
        std::swap(frame_, before_);
        break;
      case 4:
        nudge();
        break;
      case 5:
        frame_.mask = shot_.step().mask;
        break;
      default:
        break;
    }
  }

 private:
  // So that how far the content reaches shows in the result's window.
  static Frame with_empty_border(Frame frame) {
    const Window& w = frame.window();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        if (x >= w.x0 + 30 && x < w.x1 - 30 && y >= w.y0 + 12 && y < w.y1 - 12) continue;
        for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, c < 3 || frame.has_alpha ? 0.f : 1.f);
        frame.depth.at(x, y) = 1e10f;
      }
    }
    return frame;
  }

  CocFunction lens() { return test::random_lens(shot_.random(), kLargest); }

  // By so little that their indices stay, or so much that only their keys in bitmaps are others.
  void nudge() {
    const Window& w = frame_.window();
    for (int i = 0; i < 8; ++i) {
      const int x = w.x0 + static_cast<int>(random()() % static_cast<unsigned>(w.width()));
      const int y = w.y0 + static_cast<int>(random()() % static_cast<unsigned>(w.height()));
      float& depth = frame_.depth.at(x, y);
      depth = random()() % 2 ? std::nextafter(depth, 1e9f) : depth * 1.01f;
    }
  }

  test::RandomShot shot_;
  Frame frame_, before_;
  CocFunction coc_;
};

class RememberingDepths : public testing::TestWithParam<unsigned> {};

TEST_P(RememberingDepths, FindsWhatLookingAtAllOfThemFinds) {
  const unsigned seed = GetParam();
  const Case c = case_for(seed);
  const Window window{-5, 3, 330, 36};
  FilterOptions options = c.options;
  IncrementalFilter filter(window, options);
  LinearFilter linear(window, options);
  const KernelTable kernels(options.kernel);
  StillShot shot(window, seed, c);
  const bool bitmaps = options.visibility.kind == VisibilityOptions::Kind::bitmap;
  const bool any_threshold = options.thresholds.any();
  for (int round = 0; round < 60; ++round) {
    shot.step();
    if (shot.random()() % 32 == 0) filter.reset();
    options.budget = shot.random()() % 3 ? Budget{} : Budget{Budget::Kind::percent, 40};
    filter.set_budget(options.budget);
    std::vector<std::int16_t> pending(window.pixels());
    const Changes expected =
        find_changes(shot.frame(), shot.coc(), kernels.coc(), Sanitiser(kernels.options().max_radiance),
                     filter.committed(), options.thresholds, pending, filter.occlusion());
    const Stats stats = filter.filter(shot.frame(), shot.coc());
    ASSERT_EQ(stats.changed, expected.pixels) << "round " << round;
    ASSERT_EQ(stats.repaired_colour, expected.findings.colour.not_finite);
    ASSERT_EQ(stats.repaired_depth, expected.findings.depth);
    ASSERT_EQ(stats.clamped_radiance, expected.findings.colour.clamped);
    ASSERT_EQ(stats.clamped_coc, expected.findings.coc_clamped);
    if (shot.random()() % 2) {
      while (filter.left_over().pixels > 0) filter.refine();
    }
    if (!bitmaps) {
      ASSERT_TRUE(test::invariant_holds(filter, kernels)) << "round " << round;
    }
    if (filter.left_over().pixels > 0 || any_threshold) continue;
    linear.filter(shot.frame(), shot.coc());
    ASSERT_EQ(test::difference(filter.result(), linear.result()), "") << "round " << round;
    ASSERT_EQ(filter.result_window(), linear.result_window()) << "round " << round;
  }
}
INSTANTIATE_TEST_SUITE_P(Shots, RememberingDepths, testing::Range(0u, 28u));

TEST(RememberingDepths, KeepsHowFarContentReaches) {
  const Window window{0, 0, 330, 40};
  Frame frame{ColourImage(window, SampleType::half), Plane(window, 1e10f), true};
  for (int y = 0; y < 20; ++y) {  // each row reaches farther than the one above, in focus
    for (int x = 0; x < 30 + 10 * y; ++x) frame.depth.at(x, y) = 2;
  }
  frame.depth.at(40, 15) = 0.5f;  // but for one pixel inside
  const CocFunction coc{DepthKind::planar, 10, 0.5f};
  FilterOptions options;
  options.kernel.max_coc_px = kLargest;
  IncrementalFilter filter(window, options);
  LinearFilter linear(window, options);
  linear.filter(frame, coc);
  for (int round = 0; round < 4; ++round) {
    filter.filter(frame, coc);
    EXPECT_EQ(filter.result_window(), linear.result_window()) << "round " << round;
  }
}

constexpr TileGrid kGrid{100, 3};
const CocFunction kLens{DepthKind::planar, 10, 0.5f};
const std::vector<float> kDepths(64, 3.f);
const SegmentFindings kFindings{5, 7, false};

RememberedDepths steady() {
  RememberedDepths depths;
  depths.reset(kGrid);
  depths.begin(kLens);
  depths.begin(kLens);
  return depths;
}

TEST(RememberedDepths, AreThoseOfSegmentsWithoutAnyChange) {
  RememberedDepths depths = steady();
  EXPECT_EQ(depths.known(0, 1), nullptr);
  depths.take(kDepths, 0, 1, {}, kFindings);
  ASSERT_NE(depths.known(0, 1), nullptr);
  EXPECT_TRUE(std::equal(kDepths.begin(), kDepths.end(), depths.known(0, 1)));
  EXPECT_EQ(depths.findings(0, 1).clamped, 5);
  EXPECT_EQ(depths.findings(0, 1).largest, 7);
  EXPECT_EQ(depths.known(64, 1), nullptr);
  EXPECT_EQ(depths.known(0, 2), nullptr);
}

TEST(RememberedDepths, AreCountedUpToTheFirstUnknownSegment) {
  RememberedDepths depths = steady();
  EXPECT_EQ(depths.known_from(0, 1, 2), 0);
  depths.take(kDepths, 0, 1, {}, kFindings);
  EXPECT_EQ(depths.known_from(0, 1, 2), 1);
  EXPECT_EQ(depths.known_from(64, 1, 1), 0);
  depths.take(kDepths, 64, 1, {}, kFindings);
  EXPECT_EQ(depths.known_from(0, 1, 2), 2);
  EXPECT_EQ(depths.known_from(0, 1, 1), 1);
  EXPECT_EQ(depths.known_from(0, 1, 0), 0);
  EXPECT_EQ(depths.known_from(64, 1, 1), 1);
}

TEST(RememberedDepths, AreNotThoseOfChangedColoursOrSuspects) {
  RememberedDepths depths = steady();
  depths.take(kDepths, 0, 0, {0, 1, false}, kFindings);
  EXPECT_EQ(depths.known(0, 0), nullptr);
  depths.take(kDepths, 0, 0, {}, {0, 7, true});
  EXPECT_EQ(depths.known(0, 0), nullptr);
}

TEST(RememberedDepths, AreForgottenWithAnyChangeOfIndexOrLens) {
  RememberedDepths depths = steady();
  depths.take(kDepths, 0, 0, {}, kFindings);
  depths.take(kDepths, 0, 0, {2, 0, false}, kFindings);
  EXPECT_EQ(depths.known(0, 0), nullptr);

  depths.take(kDepths, 0, 0, {}, kFindings);
  CocFunction scaled = kLens;
  scaled.artistic.behind = 2;
  depths.begin(scaled);
  EXPECT_EQ(depths.known(0, 0), nullptr);
  depths.begin(kLens);
  EXPECT_EQ(depths.known(0, 0), nullptr) << "the lens of before is another one now";
  depths.take(kDepths, 0, 0, {}, kFindings);
  EXPECT_EQ(depths.known(0, 0), nullptr) << "not during a focus pull";
}

}  // namespace
}  // namespace pullfocus
