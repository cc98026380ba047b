// Rows of indices, against the same asked pixel by pixel.
#include "scatter/index_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "scatter/state.h"
#include "targets.h"

namespace pullfocus {
namespace {

TEST(IndexRow, RangesAndLargestEqualThePlainOnesForAnyIndices) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937 random(1);
    for (int round = 0; round < 5000; ++round) {
      const int most = 1 + static_cast<int>(random() % (round % 3 ? 40 : 32766));
      const auto any = [&] { return static_cast<std::int16_t>(static_cast<int>(random() % (2u * most + 1)) - most); };
      std::int16_t index[kTileWidth];
      for (std::int16_t& i : index) i = any();
      if (round % 2) index[random() % kTileWidth] = random() % 2 ? kHeldOut : kNeverCommitted;
      const std::int16_t first = any(), last = any();
      const std::uint64_t asked = (std::uint64_t{random()} << 32 | random()) >> random() % 64;
      std::uint64_t expected = 0;
      int largest = 0;
      for (int i = 0; i < kTileWidth; ++i) {
        expected |= std::uint64_t{first <= index[i] && index[i] <= last} << i;
        if ((asked & expected) >> i & 1) largest = std::max(largest, std::abs(int{index[i]}));
      }
      ASSERT_EQ(within(index, first, last), expected) << test::simd_target_name(target);
      ASSERT_EQ(largest_of(index, asked & expected), largest) << test::simd_target_name(target);
    }
  }
}

}  // namespace
}  // namespace pullfocus
