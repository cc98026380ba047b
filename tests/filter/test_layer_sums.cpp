// Sums of layers, against plain planes.
#include "resolve/layer_sums.h"

#include <gtest/gtest.h>

#include <tbb/parallel_for.h>

#include <random>

namespace pullfocus {
namespace {

// Rows of one layer that is reached everywhere but in the third quarter of the rows; the other layer stays empty.
void check_replacing(int width, int height, int lanes) {
  LayerSums sums;
  sums.reset(width, height, 2, lanes);
  const auto row_size = static_cast<std::size_t>(width) * static_cast<std::size_t>(lanes);
  const ColumnSpan whole[] = {{0, width}};
  for (const unsigned round : {1u, 2u}) {
    std::vector<Accumulator> expected(row_size * static_cast<std::size_t>(height));
    sums.begin_anew();
    sums.make_room(1, {0, 0, width, height});
    tbb::parallel_for(0, height, [&](int y) {
      if (y * 4 / height == 2) return;
      std::mt19937_64 random(round + static_cast<unsigned>(y));
      Accumulator* const row = &expected[static_cast<std::size_t>(y) * row_size];
      for (std::size_t i = 0; i < row_size; ++i) row[i] = random();
      const LayerRow rows[] = {{1, row, whole}};
      sums.replace_row(y, rows);
    });
    sums.end_anew();
    ASSERT_EQ(sums.plane(1), expected) << width << " x " << height;
    ASSERT_EQ(sums.tiles(0), 0);
  }
}

TEST(LayerSums, AreReplacedToTheLastBitWhereCachesHoldThem) {
  check_replacing(1, 1, kOpaqueLanes);
  check_replacing(131, 37, kAlphaLanes);
}

TEST(LayerSums, AreReplacedToTheLastBitWhereCachesDoNotHoldThem) {
  check_replacing(1283, 801, kOpaqueLanes);
  check_replacing(1283, 801, kAlphaLanes);
}

}  // namespace
}  // namespace pullfocus
