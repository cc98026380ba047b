// What is filled in behind foregrounds that do not hide it.
#include "resolve/backdrop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "filter/incremental_filter.h"
#include "filter/linear_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"
#include "resolve/resolve.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::set_colour;

FilterOptions with_layers(double max_coc, std::vector<double> borders = {-2, 2}) {
  FilterOptions options = test::options_up_to(max_coc);
  options.visibility.kind = VisibilityOptions::Kind::layers;
  options.visibility.borders = std::move(borders);
  return options;
}

// A bar in front of focus, `coc` px blurred, before a sharp background.
Frame bar_frame(const Window& window, const Window& bar, float coc, const test::Rgba& behind) {
  Frame frame = flat_frame(window, SampleType::float32, behind, 0);
  for_each_in(intersect(bar, window), [&](int x, int y) {
    frame.depth.at(x, y) = -coc;
    set_colour(frame.colour, x, y, {1, 0, 0, 1});
  });
  return frame;
}

TEST(Backdrop, ABarThatIsThinnerThanItsBlurLetsTheSharpBackgroundThrough) {
  const Window window{0, 0, 101, 40};
  const Frame frame = bar_frame(window, {46, 0, 55, 40}, 30, {0, 0, 1, 1});
  IncrementalFilter filter(window, with_layers(40));
  filter.filter(frame, coc_as_depth);
  const double covers = static_cast<double>(kCoveringWeight);
  for (int x = 40; x < 61; ++x) {  // behind the bar and beside it alike
    const auto sums = filter.accumulators(0);
    const double weight =
        static_cast<double>(sums[(20 * 101 + static_cast<std::size_t>(x)) * 4 + kWeightLane]) / covers;
    EXPECT_GT(weight, 0.2) << x;
    EXPECT_NEAR(static_cast<double>(filter.result().get(x, 20, 0)), weight, 0.01) << x;
    EXPECT_NEAR(static_cast<double>(filter.result().get(x, 20, 2)), 1 - weight, 0.01) << x;
  }
}

TEST(Backdrop, WhatCoversAPixelIsNotFilled) {
  const Window window{0, 0, 160, 60};
  const Frame frame = bar_frame(window, {40, 0, 120, 60}, 20, {0, 0, 1, 1});
  LinearFilter filter(window, with_layers(40));
  filter.filter(frame, coc_as_depth);
  for (int x = 55; x < 105; ++x) EXPECT_EQ(filter.result().get(x, 30, 2), 0) << x;
}

TEST(Backdrop, FillSetsInSmoothlyWithTheDistanceOfWhatIsSeen) {
  // One narrow gap, ever farther away from a hole that nothing covers well.
  double last = 1;
  for (int gap = 110; gap <= 180; gap += 5) {
    const Window window{0, 0, 260, 1};
    Backdrop backdrop(260, 1);
    ColourImage out(window, SampleType::float32);
    for (int x = 0; x < 260; x += Backdrop::kChunk) {
      Backdrop::Chunk chunk;
      for (int i = 0; i < Backdrop::kChunk; ++i) {
        if (x + i == 100) {
          chunk.holes |= 1u << i;
          chunk.amount[i] = 1;
          std::fill_n(chunk.colour[i], 4, 0.f);
        } else if (x + i == gap) {
          chunk.shows |= 1u << i;
          std::fill_n(chunk.colour[i], 4, 1.f);
        }
      }
      backdrop.take(x, 0, chunk);
    }
    backdrop.fill(out);
    const auto value = static_cast<double>(out.get(100, 0, 1));
    const double d = gap - 100, w = d <= 64 ? 1 / d - 1. / 65 : 0;
    EXPECT_NEAR(value, w / (w + 1. / 256), 1e-6);
    EXPECT_LE(value, last);
    last = value;
  }
  EXPECT_EQ(last, 0);
}

// The definition, pixel by pixel, from the sums of the layers.
class PlainBackdrop {
 public:
  explicit PlainBackdrop(const IncrementalFilter& filter) : filter_(filter) {
    for (int l = 0; l < filter.layers().count(); ++l) planes_.push_back(filter.accumulators(l));
    near_ = static_cast<std::size_t>(filter.layers().near());
  }

  void expect_result() const {
    const Window& w = filter_.result().window();
    for_each_in(w, [&](int x, int y) {
      double colour[4];
      if (!filled(x - w.x0, y - w.y0, colour)) return;
      for (int c = 0; c < 4; ++c) {
        ASSERT_NEAR(static_cast<double>(filter_.result().get(x, y, c)), colour[c], 2e-6 * (1 + std::fabs(colour[c])))
            << x << "," << y << " channel " << c;
      }
    });
  }

 private:
  double weight(std::size_t layer, int x, int y) const {
    return lane(layer, x, y, kWeightLane) / static_cast<double>(kCoveringWeight);
  }
  double lane(std::size_t layer, int x, int y, int lane) const {
    const Window& w = filter_.result().window();
    const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(w.width()) + static_cast<std::size_t>(x)) *
                    static_cast<std::size_t>(filter_.lanes());
    return static_cast<double>(static_cast<std::int64_t>(planes_[layer][at + static_cast<std::size_t>(lane)]));
  }
  double sum(std::size_t first, std::size_t last, int x, int y) const {
    double total = 0;
    for (std::size_t l = first; l < last; ++l) total += weight(l, x, y);
    return total;
  }

  // Layers from `first` on, front to back; returns what is free before the farthest takes it.
  double compose(std::size_t first, int x, int y, double* colour) const {
    double free = 1, share[kMostLayers] = {};
    std::size_t farthest = planes_.size(), n = 0;
    for (std::size_t l = first; l < planes_.size(); ++l) {
      if (weight(l, x, y) == 0) continue;
      share[l] = std::min(weight(l, x, y), free);
      free -= share[l];
      farthest = l;
      ++n;
    }
    std::fill_n(colour, 4, 0.);
    if (n == 0) return -1;
    share[farthest] += free;
    for (std::size_t l = first; l < planes_.size(); ++l) {
      if (weight(l, x, y) == 0) continue;
      for (int c = 0; c < 4; ++c) {
        const int at = c < 3 ? c : filter_.lanes() == kAlphaLanes ? kAlphaLane : kWeightLane;
        colour[c] += share[l] * lane(l, x, y, at) / lane(l, x, y, kWeightLane);
      }
    }
    return free;
  }

  bool filled(int x, int y, double* colour) const {
    const double free = compose(0, x, y, colour);
    const std::size_t count = planes_.size();
    if (free <= 1. / 8 || sum(0, near_, x, y) == 0 || sum(near_, count, x, y) > 0) return free >= 0;
    const Window& w = filter_.result().window();
    double total = 1. / 256, rest[4];
    for (int c = 0; c < 4; ++c) rest[c] = colour[c] / 256;
    constexpr int steps[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (const auto& step : steps) {
      for (int d = 1; d <= 64; ++d) {
        const int sx = x + d * step[0], sy = y + d * step[1];
        if (sx < 0 || sy < 0 || sx >= w.width() || sy >= w.height()) break;
        if (sum(0, near_, sx, sy) == 0 || sum(near_, count, sx, sy) < 1. / 8) continue;
        double seen[4];
        compose(near_, sx, sy, seen);
        for (int c = 0; c < 4; ++c) rest[c] += seen[c] * (1. / d - 1. / 65);
        total += 1. / d - 1. / 65;
        break;
      }
    }
    const double amount = std::min(free, 2 * free - 1. / 4);
    for (int c = 0; c < 4; ++c) colour[c] += amount * (rest[c] / total - colour[c]);
    return true;
  }

  const IncrementalFilter& filter_;
  std::vector<std::vector<Accumulator>> planes_;
  std::size_t near_;
};

TEST(Backdrop, RandomShotsShowWhatTheDefinitionSays) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const Window window{-5, 4, 60 + static_cast<int>(seed) * 13, 50 + static_cast<int>(seed) * 7};
    FilterOptions options =
        with_layers(30, seed % 3 == 0 ? std::vector<double>{-8, -2, 2} : std::vector<double>{-2, 2});
    options.budget.amount = seed % 2 ? 100 : 40;
    test::RandomShot shot(window, seed, SampleType::float32, seed % 2, false);
    IncrementalFilter filter(window, options);
    for (int frame = 0; frame < 5; ++frame) {
      if (frame > 0) shot.step();
      filter.filter(shot.frame(), test::random_lens(shot.random(), 30));
    }
    if (std::ranges::count(filter.committed().index, kNeverCommitted) > 0) continue;
    PlainBackdrop(filter).expect_result();
  }
}

TEST(Backdrop, WhatChangesFarFromAHoleReachesItAndNothingElseDoes) {
  const Window window{3, -2, 230, 180};
  std::mt19937 random(4);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Frame frame = bar_frame(window, {60, -2, 170, 180}, 220, {0.2f, 0.4f, 0.6f, 1});
  for_each_in({3, 50, 230, 112}, [&](int x, int y) {
    frame.depth.at(x, y) = -78;
    set_colour(frame.colour, x, y, {0, 1, 0, 1});
  });
  IncrementalFilter incremental(window, with_layers(220));
  LinearFilter linear(window, with_layers(220));
  for (int step = 0; step < 60; ++step) {
    const int x0 = window.x0 + below(225), y0 = window.y0 + below(178);
    Window patch = intersect({x0, y0, x0 + 1 + below(12), y0 + 1 + below(12)}, window);
    if (step % 2) patch.x0 = step % 4 == 1 ? 58 : 170;  // beside the bar, in the background
    if (step % 2) patch.x1 = patch.x0 + 2;
    const bool moves = step % 2 == 0 && below(5) == 0;
    for_each_in(patch, [&](int x, int y) {
      if (moves) frame.depth.at(x, y) = below(2) ? 0 : -50;
      set_colour(frame.colour, x, y, {static_cast<float>(below(100)) / 100, 0.5f, 0, 1});
    });
    const Stats& stats = incremental.filter(frame, coc_as_depth);
    linear.filter(frame, coc_as_depth);
    ASSERT_EQ(test::difference(incremental.result(), linear.result()), "") << "step " << step;
    if (step > 0) {
      ASSERT_LE(stats.updated, 144);
    }
  }
  PlainBackdrop(incremental).expect_result();
}

TEST(Backdrop, RowsThatNothingReachesAnyMoreShowNothing) {
  // First what is behind the bar is seen above its upper end; then all of that is held out, and no light gets there.
  const Window window{0, 0, 64, 120};
  Frame frame = bar_frame(window, {28, 46, 36, 120}, 20, {0, 0, 1, 1});
  LinearFilter used(window, with_layers(20)), fresh(window, with_layers(20));
  IncrementalFilter incremental(window, with_layers(20));
  used.filter(frame, coc_as_depth);
  incremental.filter(frame, coc_as_depth);
  frame.mask.reset(window, 0);
  for_each_in({0, 0, 64, 60}, [&](int x, int y) { frame.mask.at(x, y) = 1; });
  used.filter(frame, coc_as_depth);
  incremental.filter(frame, coc_as_depth);
  fresh.filter(frame, coc_as_depth);
  EXPECT_EQ(test::difference(used.result(), fresh.result()), "");
  EXPECT_EQ(test::difference(incremental.result(), fresh.result()), "");
}

TEST(Backdrop, HoldsNoMemoryWhereNothingIsInFront) {
  Backdrop backdrop(64, 32);
  const std::size_t empty = backdrop.bytes();
  Backdrop::Chunk chunk;
  chunk.shows = 1;
  backdrop.take(32, 3, chunk);
  EXPECT_EQ(backdrop.bytes(), empty + sizeof chunk);
  backdrop.take_none(32, 3);
  EXPECT_EQ(backdrop.bytes(), empty);
}

}  // namespace
}  // namespace pullfocus
