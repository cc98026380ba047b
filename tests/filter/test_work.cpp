// What an update costs, in counters: only what changed, and never much more than starting afresh.
#include <gtest/gtest.h>

#include <random>

#include "filter/incremental_filter.h"
#include "filter/linear_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::options_up_to;

constexpr auto half = SampleType::half;
const Window window{-3, 2, 147, 72};

class Work : public testing::Test {
 protected:
  std::int64_t edges(float diameter) const { return kernels_->kernel(kernels_->coc().index(diameter)).edge_count(); }

  FilterOptions options_ = options_up_to(30);
  std::shared_ptr<const KernelTable> kernels_ = std::make_shared<const KernelTable>(options_.kernel);
  IncrementalFilter filter_{window, options_, kernels_};
};

TEST_F(Work, OfAnUnchangedFrameIsNone) {
  test::RandomShot shot(window, 4, half, true, true);
  const CocFunction coc = test::random_lens(shot.random(), 30);
  filter_.filter(shot.frame(), coc);
  for (int round = 0; round < 2; ++round) {
    const Stats& stats = filter_.filter(shot.frame(), coc);
    EXPECT_EQ(stats.mode, ScatterMode::unchanged);
    EXPECT_EQ(stats.changed, 0);
    EXPECT_EQ(stats.edges, 0);
    EXPECT_EQ(stats.resolved, 0);
  }
}

TEST_F(Work, OfALinearFrameIsEveryPixelsKernel) {
  Frame frame = flat_frame(window, half, {0.5f, 0.5f, 0.5f, 1}, 0);
  std::mt19937 random(1);
  std::int64_t expected = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const float diameter = 30 * std::uniform_real_distribution<float>(-1, 1)(random);
      frame.depth.at(x, y) = diameter;
      expected += edges(diameter);
    }
  }
  EXPECT_EQ(LinearFilter(window, options_, kernels_).filter(frame, coc_as_depth).edges, expected);
}

TEST_F(Work, OfOneColourIsOneKernel) {
  for (const float d : {0.f, 1.f, 9.f, -30.f}) {
    Frame frame = flat_frame(window, half, {0.5f, 0.5f, 0.5f, 1}, d);
    filter_.filter(frame, coc_as_depth);
    frame.colour.set(60, 30, 2, 0.75f);
    const Stats& stats = filter_.filter(frame, coc_as_depth);
    EXPECT_EQ(stats.mode, ScatterMode::incremental);
    EXPECT_EQ(stats.updated, 1);
    EXPECT_EQ(stats.edges, edges(d)) << d << " px";
  }
}

TEST_F(Work, OfOneCoCIsTheOldKernelAndTheNewOne) {
  for (const auto& [from, to] : {std::pair{0.f, 12.f}, {12.f, 0.f}, {7.f, -7.f}, {30.f, 29.f}}) {
    Frame frame = flat_frame(window, half, {0.5f, 0.5f, 0.5f, 1}, from);
    filter_.filter(frame, coc_as_depth);
    frame.depth.at(60, 30) = to;
    const Stats& stats = filter_.filter(frame, coc_as_depth);
    EXPECT_EQ(stats.updated, 1);
    EXPECT_EQ(stats.edges, edges(from) + edges(to)) << from << " to " << to << " px";
  }
}

TEST_F(Work, OfOnePixelResolvesItsNeighbourhoodOnly) {
  Frame frame = flat_frame(window, half, {0.5f, 0.5f, 0.5f, 1}, 4.f);
  filter_.filter(frame, coc_as_depth);
  frame.colour.set(60, 30, 2, 0.75f);
  const Stats& stats = filter_.filter(frame, coc_as_depth);
  const Kernel& kernel = kernels_->kernel(kernels_->coc().index(4.f));
  // Rows of the whole tile, columns in cells of 32 around the tile.
  EXPECT_GE(stats.resolved, (2 * kernel.radius_x + 1) * (2 * kernel.radius_y + 1));
  EXPECT_LE(stats.resolved, (64 + 2 * (kernel.radius_x + 32)) * (16 + 2 * kernel.radius_y));
}

TEST_F(Work, BelowTheQuantisationIsNone) {
  Frame frame = flat_frame(window, half, {0.5f, 0.5f, 0.5f, 1}, 4.f);
  filter_.filter(frame, coc_as_depth);
  frame.depth.reset(window, 4.1f);
  EXPECT_EQ(filter_.filter(frame, coc_as_depth).changed, 0);
}

TEST_F(Work, OfAFullChangeIsThatOfTheLinearFilter) {
  LinearFilter linear(window, options_, kernels_);
  test::RandomShot one(window, 5, half, true, false), other(window, 6, half, true, false);
  const CocFunction coc = test::random_lens(one.random(), 30);
  for (const test::RandomShot* shot : {&one, &other, &one}) {
    const Stats& stats = filter_.filter(shot->frame(), coc);
    const Stats& expected = linear.filter(shot->frame(), coc);
    EXPECT_EQ(stats.mode, ScatterMode::rebuild);
    EXPECT_EQ(stats.edges, expected.edges);
    EXPECT_EQ(expected.mode, ScatterMode::rebuild);
    EXPECT_EQ(expected.changed, 150 * 70);
    EXPECT_EQ(expected.updated, 150 * 70);
    EXPECT_EQ(expected.resolved, 150 * 70);
    EXPECT_EQ(test::difference(filter_.result(), linear.result()), "");
  }
}

// The price of not being linear is bounded, whatever share of the pixels changes.
TEST_F(Work, NeverWritesNoticeablyMoreEdgesThanTheLinearFilter) {
  LinearFilter linear(window, options_, kernels_);
  test::RandomShot shot(window, 7, half, true, false);
  const CocFunction coc = test::random_lens(shot.random(), 30);
  filter_.filter(shot.frame(), coc);
  bool incremental = false, rebuilt = false;
  for (int width = 1; width <= window.width(); width += 7) {
    Frame frame = shot.frame();
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x0 + width; ++x) frame.depth.at(x, y) = 1.f + static_cast<float>(width) / 10;
    }
    const Stats& stats = filter_.filter(frame, coc);
    const Stats& expected = linear.filter(frame, coc);
    // Going to a near index writes the edges of both kernels in one pass, at 3/5 of the cost (rebuild_is_cheaper).
    EXPECT_LE(3 * stats.edges, 5 * expected.edges) << width << " columns";
    EXPECT_EQ(test::difference(filter_.result(), linear.result()), "");
    incremental |= stats.mode == ScatterMode::incremental;
    rebuilt |= stats.mode == ScatterMode::rebuild;
  }
  EXPECT_TRUE(incremental && rebuilt);
}

}  // namespace
}  // namespace pullfocus
