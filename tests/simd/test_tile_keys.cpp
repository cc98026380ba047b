// Ranges of keys, against the same pixel by pixel.
#include "importance/tile_keys.h"

#include <gtest/gtest.h>

#include <random>

#include "targets.h"

namespace pullfocus {
namespace {

TEST(KeysWithin, AreThoseOfTheMaskBetweenBothEndsOnEveryTarget) {
  std::mt19937 random(3);
  const auto any = [&](unsigned most) { return static_cast<unsigned>(random() % (most + 1)); };
  for (int round = 0; round < 400; ++round) {
    const unsigned largest = round % 2 ? TileKeys::kMost : 12;
    TileKeys keys;
    TileMask mask;
    for (int i = 0; i < kTileHeight; ++i) {
      mask.rows[i] = any(3) == 0 ? any(1) * ~std::uint64_t{0} : std::uint64_t{random()} << 32 | random();
      for (std::uint16_t& key : keys.of[i]) {
        key = static_cast<std::uint16_t>(any(9) == 0 ? any(1) * TileKeys::kMost : any(largest));
      }
    }
    const unsigned least = round % 5 == 0 ? 0 : any(largest + 1),
                   most = round % 7 == 0 ? TileKeys::kMost : any(largest);
    for (const std::int64_t target : test::simd_targets()) {
      const test::OnTarget on(target);
      const TileMask is = within(keys, mask, least, most);
      for (int i = 0; i < kTileHeight; ++i) {
        for (int p = 0; p < kTileWidth; ++p) {
          const bool expected = (mask.rows[i] >> p & 1) != 0 && keys.of[i][p] >= least && keys.of[i][p] <= most;
          ASSERT_EQ((is.rows[i] >> p & 1) != 0, expected)
              << test::simd_target_name(target) << ", " << least << " to " << most << ", row " << i << ", pixel " << p;
        }
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
