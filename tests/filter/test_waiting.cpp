// The age rule: half of a partial budget serves those that wait longest, so that nothing starves.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "filter/incremental_filter.h"
#include "plain_frames.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

const Window window{0, 0, 70, 40};

bool committed(const IncrementalFilter& filter, const Frame& frame, int x, int y) {
  for (int c = 0; c < 4; ++c) {
    if (filter.committed().colour.get(x, y, c) != frame.colour.get(x, y, c)) return false;
  }
  return true;
}

// Runs frames in which the pixels of `changing` get new colours every time, the nearer to the left the larger the
// change; returns the longest run of calls for which any pixel's change was left over.
int longest_wait(double percent, int frames, bool keep_changing) {
  FilterOptions options = options_up_to(3);
  options.budget = {Budget::Kind::percent, percent};
  IncrementalFilter filter(window, options);
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 1);
  filter.filter(frame, coc_as_depth);
  std::map<int, int> waits;
  int longest = 0;
  for (int f = 1; f <= frames; ++f) {
    if (keep_changing || f == 1) {
      for_each_in(window, [&](int x, int y) {
        frame.colour.set(x, y, 0,
                         0.5f + static_cast<float>(f) * static_cast<float>(window.x1 - x) + static_cast<float>(y));
      });
    }
    const Stats& stats = filter.filter(frame, coc_as_depth);
    EXPECT_EQ(stats.changed, stats.updated + stats.left_over);
    for_each_in(window, [&](int x, int y) {
      int& wait = waits[y * window.width() + x];
      wait = committed(filter, frame, x, y) ? 0 : wait + 1;
      longest = std::max(longest, wait);
    });
  }
  return longest;
}

TEST(Waiting, NobodyWaitsLongerThanTwiceTheFramesTheBudgetWouldTakeWhileEverythingKeepsChanging) {
  for (const double percent : {7., 15., 40., 75.}) {
    EXPECT_LE(longest_wait(percent, 60, true), static_cast<int>(std::ceil(200 / percent))) << percent;
  }
}

TEST(Waiting, NobodyWaitsLongerEitherWhenChangesStopAndTheBudgetShrinksWithWhatIsLeft) {
  for (const double percent : {5., 20., 50.}) {
    EXPECT_LE(longest_wait(percent, 60, false), static_cast<int>(std::ceil(200 / percent))) << percent;
  }
}

TEST(Waiting, HalfOfACountBudgetServesTheOldest) {
  FilterOptions options = options_up_to(3);
  options.budget = {Budget::Kind::count, 100};
  IncrementalFilter filter(window, options);
  Frame frame = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 1);
  filter.filter(frame, coc_as_depth);
  // Faint changes on the left first; then strong ones on the right in every frame.
  for_each_in({0, 0, 10, 40}, [&](int x, int y) { frame.colour.set(x, y, 0, 0.51f); });
  filter.filter(frame, coc_as_depth);
  const auto left_done = [&] {
    int done = 0;
    for_each_in({0, 0, 10, 40}, [&](int x, int y) { done += committed(filter, frame, x, y); });
    return done;
  };
  EXPECT_EQ(left_done(), 100);
  for (int f = 1; f <= 4; ++f) {
    for_each_in({30, 0, 70, 40}, [&](int x, int y) { frame.colour.set(x, y, 1, static_cast<float>(10 + f)); });
    EXPECT_EQ(filter.filter(frame, coc_as_depth).updated, 100);
    // All that waits on the left is older than anything on the right, and goes first within its half.
    EXPECT_EQ(left_done(), 100 + 50 * f);
  }
}

TEST(Waiting, APixelThatReturnsToWhatWasCommittedWaitsNoLonger) {
  FilterOptions options = options_up_to(3);
  options.budget = {Budget::Kind::count, 1};
  IncrementalFilter filter(window, options);
  const Frame before = flat_frame(window, SampleType::float32, {0.5f, 0.5f, 0.5f}, 1);
  Frame after = before;
  for_each_in({0, 0, 4, 4}, [&](int x, int y) { after.colour.set(x, y, 0, 0.6f); });
  filter.filter(before, coc_as_depth);
  EXPECT_EQ(filter.filter(after, coc_as_depth).left_over, 15);
  EXPECT_EQ(filter.filter(before, coc_as_depth).left_over, 0);
  // A strong new change is not older than the faint ones that come back: importance decides.
  after.colour.set(60, 30, 0, 9);
  EXPECT_EQ(filter.filter(after, coc_as_depth).updated, 1);
  EXPECT_TRUE(committed(filter, after, 60, 30));
}

TEST(Waiting, MergedAndWithoutAreUnionAndDifference) {
  std::mt19937 random(4);
  const auto draw = [&] {
    std::vector<TileWork> tiles;
    for (int n = 0; n < 12; ++n) {
      TileWork work{static_cast<int>(random() % 30), static_cast<int>(random() % 9), {}};
      work.mask.rows[random() % kTileHeight] = random() | std::uint64_t{random()} << 32 | 1;
      tiles.push_back(work);
    }
    return tiles;
  };
  const auto contains = [](const std::vector<TileWork>& tiles, int tile, int row, int bit) {
    for (const TileWork& work : tiles) {
      if (work.tile == tile && (work.mask.rows[row] >> bit & 1) != 0) return true;
    }
    return false;
  };
  const auto a = draw(), b = draw();
  const auto all = merged(a), rest = without(all, merged(b));
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LT(all[i - 1].tile, all[i].tile);
  for (int tile = 0; tile < 30; ++tile) {
    for (int row = 0; row < kTileHeight; ++row) {
      for (int bit = 0; bit < 64; ++bit) {
        ASSERT_EQ(contains(all, tile, row, bit), contains(a, tile, row, bit));
        ASSERT_EQ(contains(rest, tile, row, bit), contains(a, tile, row, bit) && !contains(b, tile, row, bit));
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
