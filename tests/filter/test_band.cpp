// Bands of destination rows, mirroring, and spans to resolve, each against a plain image.
#include "scatter/band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "resolve/spans.h"

namespace pullfocus {

static void PrintTo(const BandLayout& layout, std::ostream* out) {
  *out << layout.width << "x" << layout.height << ", pad " << layout.pad << ", " << layout.lanes << " lanes";
}

namespace {

// Reflection by walking: at a border, turn round and stay one step on the spot.
int walk(int steps, int size) {
  int x = 0, direction = 1;
  const auto step = [&](int way) {
    const int next = x + way * direction;
    if (next < 0 || next >= size) {
      direction = -direction;
    } else {
      x = next;
    }
  };
  for (; steps > 0; --steps) step(1);
  for (; steps < 0; ++steps) step(-1);
  return x;
}

TEST(BandHeight, IsAnEqualShareOfTheRowsForEveryThreadAndRound) {
  for (const int reach : {0, 10, 80, 500}) {
    for (int threads = 1; threads <= 9; ++threads) {
      for (int span = 1; span <= 5000; span += 1 + span / 7) {
        for (const int width : {1, 1920, 100000}) {
          for (const int layers : {1, 3, 16}) {
            const int height = band_height(span, reach, layers, threads, {width, span});
            const int bands = (span + height - 1) / height, rounds = (bands + threads - 1) / threads;
            ASSERT_GE(height, 1);
            ASSERT_LE(height, 128);
            ASSERT_LE(height, (span + rounds * threads - 1) / (rounds * threads)) << span << " rows, " << threads;
          }
        }
      }
    }
  }
}

TEST(BandHeight, FallsWithTheBytesOfARowUnlessItIsLowOrKernelsReachFar) {
  const auto height = [](int reach, const BandLayout& layout) {
    return band_height(layout.height, reach, 1, 1, layout);
  };
  const BandLayout hd{1920, 12800}, uhd{3840, 12800}, with_alpha{1920, 12800, 0, kAlphaLanes};
  EXPECT_LT(height(5, hd), 128);
  EXPECT_LT(height(5, uhd), height(5, hd));
  EXPECT_GT(height(5, {1000000, 12800}), 60);
  EXPECT_LT(height(5, with_alpha), height(5, hd));
  EXPECT_EQ(height(5, {640, 12800}), 128);
  EXPECT_GE(height(40, uhd), 90);
}

TEST(BandHeight, LeavesRoomForTheSumsOfAllLayersUnlessKernelsReachFar) {
  const BandLayout hd{1920, 12800};
  const auto height = [&](int reach, int layers) { return band_height(hd.height, reach, layers, 1, hd); };
  EXPECT_LE(2 * height(5, 2), height(5, 1) + 1);
  EXPECT_LE(3 * height(5, 3), height(5, 1) + 2);
  EXPECT_LE(height(5, 16), 12);
  EXPECT_GE(height(5, 16), 8);
  EXPECT_GE(height(20, 16), 45);
  EXPECT_EQ(height(40, 16), height(40, 1));
}

TEST(BandHeight, StaysLowWhereFewRowsAreWritten) {
  for (int threads = 1; threads <= 9; ++threads) EXPECT_LE(band_height(100, 10, 1, threads, {256, 256}), 25) << threads;
}

TEST(Mirror, EqualsWalkingToAndFroBetweenTheBorders) {
  for (int size = 1; size <= 9; ++size) {
    for (int x = -60; x <= 60; ++x) ASSERT_EQ(mirror(x, size), walk(x, size)) << x << " in " << size;
  }
}

struct Footprint {
  int x, radius, y;
};

// Finishes a row, visits its spans, and clears it.
template <typename Visit>
void finish_row(Band& band, int y, int lanes, Visit&& visit) {
  std::vector<ColumnSpan> spans;
  band.finish_row(y, spans);
  for (const ColumnSpan& span : spans) {
    visit(span.x0, span.x1,
          static_cast<const Accumulator*>(band.row(y) + static_cast<std::ptrdiff_t>(span.x0) * lanes));
  }
  band.clear_row(y, spans);
}

class BandTest : public testing::TestWithParam<BandLayout> {
 protected:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  // Writes the two edges of a run of `value`s and adds the same run, folded by hand, to the plain image.
  void write(Band& band, const Footprint& f, std::vector<Accumulator>& plain) {
    const BandLayout& layout = GetParam();
    band.mark(f.y, f.y + 1, f.x - f.radius, f.x + f.radius + 2);
    for (int lane = 0; lane < layout.lanes; ++lane) {
      const Accumulator value = random_() - (Accumulator{1} << 31);
      Accumulator* const at = band.row(f.y) + lane;
      at[static_cast<std::ptrdiff_t>(f.x - f.radius) * layout.lanes] += value;
      at[static_cast<std::ptrdiff_t>(f.x + f.radius + 1) * layout.lanes] -= value;
      for (int x = f.x - f.radius; x <= f.x + f.radius; ++x) {
        plain[(static_cast<std::size_t>(f.y) * layout.width + walk(x, layout.width)) * layout.lanes + lane] += value;
      }
    }
  }

  // All rows as an image, spans disjoint and ascending.
  std::vector<Accumulator> finish(Band& band) {
    const BandLayout& layout = GetParam();
    std::vector<Accumulator> image(static_cast<std::size_t>(layout.width) * layout.height * layout.lanes);
    for (int y = band.y0(); y < band.y1(); ++y) {
      int end = 0;
      finish_row(band, y, layout.lanes, [&](int x0, int x1, const Accumulator* values) {
        EXPECT_LE(end, x0);
        EXPECT_LT(x0, x1);
        EXPECT_LE(x1, layout.width);
        std::copy_n(values, static_cast<std::size_t>(x1 - x0) * layout.lanes,
                    &image[(static_cast<std::size_t>(y) * layout.width + x0) * layout.lanes]);
        end = x1;
      });
    }
    return image;
  }

  std::mt19937 random_{3};
};

TEST_P(BandTest, SumsAndFoldsWhatWasMarkedAndWritten) {
  const BandLayout& layout = GetParam();
  Band band;
  for (int round = 0; round < 6; ++round) {
    const int y0 = below(layout.height), y1 = y0 + 1 + below(layout.height - y0);
    std::vector<Accumulator> plain(static_cast<std::size_t>(layout.width) * layout.height * layout.lanes);
    band.begin(layout, y0, y1);
    for (int i = below(12); i >= 0; --i) {
      write(band, {below(layout.width), below(layout.pad), y0 + below(y1 - y0)}, plain);
    }
    ASSERT_EQ(finish(band), plain) << "round " << round;
  }
}

TEST_P(BandTest, IsCleanAfterItsRowsWereFinished) {
  const BandLayout& layout = GetParam();
  Band band;
  std::vector<Accumulator> plain(static_cast<std::size_t>(layout.width) * layout.height * layout.lanes);
  band.begin(layout, 0, layout.height);
  for (int i = 0; i < 40; ++i) {
    write(band, {below(layout.width), below(layout.pad), below(layout.height)}, plain);
  }
  finish(band);
  for (int y = 0; y < layout.height; ++y) {
    finish_row(band, y, layout.lanes, [](int, int, const Accumulator*) { ADD_FAILURE() << "still dirty"; });
  }
  // Another layout lies differently over the same memory, so that remains anywhere would show.
  const BandLayout other{layout.width, layout.height, layout.pad, kOpaqueLanes + kAlphaLanes - layout.lanes};
  band.begin(other, 0, layout.height);
  band.mark(0, layout.height, -layout.pad, layout.width + layout.pad);
  for (int y = 0; y < layout.height; ++y) {
    finish_row(band, y, other.lanes, [&](int x0, int x1, const Accumulator* values) {
      ASSERT_EQ(x1 - x0, layout.width);
      for (int i = 0; i < layout.width * other.lanes; ++i) ASSERT_EQ(values[i], 0u);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Layouts, BandTest,
                         testing::Values(BandLayout{1, 3, 1, 4}, BandLayout{1, 2, 200, 5}, BandLayout{9, 5, 40, 4},
                                         BandLayout{33, 7, 20, 5}, BandLayout{64, 16, 32, 4}, BandLayout{2030, 3, 9, 5},
                                         BandLayout{2049, 2, 300, 4}, BandLayout{4095, 2, 1, 5},
                                         BandLayout{4200, 3, 77, 4}));

TEST(DirtySpans, DrainAllThatWasMarkedAndNothingFartherThanACell) {
  std::mt19937 random(5);
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  for (const int width : {1, 31, 32, 33, 100, 2047, 2048, 2049, 4100}) {
    const int height = 3;
    DirtySpans spans;
    spans.reset(width, height);
    for (int round = 0; round < 20; ++round) {
      std::vector<std::vector<bool>> marked(height, std::vector<bool>(width)), near = marked;
      for (int i = below(6); i > 0; --i) {
        const int y = below(height), x0 = below(width), x1 = x0 + 1 + below(width - x0);
        spans.mark(y, x0, x1);
        for (int x = x0; x < x1; ++x) marked[y][x] = true;
        for (int x = x0 / 32 * 32; x < std::min((x1 + 31) / 32 * 32, width); ++x) near[y][x] = true;
      }
      for (int y = 0; y < height; ++y) {
        int end = -1;
        spans.drain_row(y, [&](int x0, int x1) {
          ASSERT_LT(end, x0) << "neighbouring spans are to be one";
          ASSERT_LT(x0, x1);
          ASSERT_LE(x1, width);
          end = x1;
          for (int x = x0; x < x1; ++x) {
            ASSERT_TRUE(near[y][x]);
            marked[y][x] = false;
          }
        });
        ASSERT_EQ(std::count(marked[y].begin(), marked[y].end(), true), 0) << "width " << width;
        spans.drain_row(y, [](int, int) { ADD_FAILURE() << "drained, yet dirty"; });
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
