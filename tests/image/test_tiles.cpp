// The tile grid covers an image once; masks are sets of pixels.
#include "image/tiles.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pullfocus {
namespace {

TEST(TileGrid, CoversEveryPixelExactlyOnce) {
  for (const int width : {1, 63, 64, 65, 128, 200}) {
    for (const int height : {1, 15, 16, 17, 32, 50}) {
      const TileGrid grid{width, height};
      std::vector<int> covered(static_cast<std::size_t>(width * height));
      ASSERT_EQ(grid.count(), grid.columns() * grid.rows());
      for (int tile = 0; tile < grid.count(); ++tile) {
        ASSERT_GE(grid.tile_width(tile), 1);
        ASSERT_LE(grid.tile_width(tile), kTileWidth);
        ASSERT_GE(grid.tile_height(tile), 1);
        ASSERT_LE(grid.tile_height(tile), kTileHeight);
        for (int y = 0; y < grid.tile_height(tile); ++y) {
          for (int x = 0; x < grid.tile_width(tile); ++x) {
            ++covered.at(static_cast<std::size_t>((grid.y(tile) + y) * width + grid.x(tile) + x));
          }
        }
      }
      for (const int times : covered) ASSERT_EQ(times, 1);
    }
  }
}

TEST(TileGrid, RunsRowByRow) {
  const TileGrid grid{130, 40};
  EXPECT_EQ(grid.columns(), 3);
  EXPECT_EQ(grid.rows(), 3);
  EXPECT_EQ(grid.x(5), 128);
  EXPECT_EQ(grid.y(5), 16);
  EXPECT_EQ(grid.tile_width(5), 2);
  EXPECT_EQ(grid.tile_height(8), 8);
}

TEST(TileMask, CountsAndVisitsItsPixelsInAscendingOrder) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 50; ++round) {
    TileMask mask;
    EXPECT_FALSE(mask.any());
    int expected_count = 0;
    for (std::uint64_t& row : mask.rows) {
      row = random() & random() & (random() % 3 ? ~std::uint64_t{0} : 0);
      std::vector<int> expected, visited;
      for (int x = 0; x < kTileWidth; ++x) {
        if (row >> x & 1) expected.push_back(x);
      }
      for_each_pixel(row, [&](int x) { visited.push_back(x); });
      ASSERT_EQ(visited, expected);
      expected_count += static_cast<int>(expected.size());
    }
    EXPECT_EQ(mask.count(), expected_count);
    EXPECT_EQ(mask.any(), expected_count > 0);
  }
}

TEST(TileMask, AnySeesASinglePixelAnywhere) {
  for (int y = 0; y < kTileHeight; ++y) {
    for (int x = 0; x < kTileWidth; ++x) {
      TileMask mask;
      mask.rows[y] = std::uint64_t{1} << x;
      ASSERT_TRUE(mask.any());
      ASSERT_EQ(mask.count(), 1);
    }
  }
}

TEST(FirstPixels, AreTheLowestBits) {
  for (int n = 0; n <= 64; ++n) {
    const std::uint64_t mask = first_pixels(n);
    for (int x = 0; x < 64; ++x) ASSERT_EQ(mask >> x & 1, x < n) << n;
  }
}

}  // namespace
}  // namespace pullfocus
