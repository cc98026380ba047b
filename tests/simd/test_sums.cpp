// Runs of accumulators, against plain loops.
#include "scatter/sums.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "targets.h"

namespace pullfocus {
namespace {

std::vector<Accumulator> random_values(std::size_t n) {
  std::mt19937_64 random(n);
  std::vector<Accumulator> values(n);
  for (Accumulator& value : values) value = random();  // sums wrap around
  return values;
}

TEST(Sums, PrefixSumsEqualPlainOnesForAnyLengthAndTouchNothingElse) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    for (const int lanes : {kOpaqueLanes, kAlphaLanes}) {
      for (int columns = 0; columns < 70; ++columns) {
        const auto n = static_cast<std::size_t>(columns * lanes);
        std::vector<Accumulator> values = random_values(n + 8), expected = values;
        for (std::size_t i = static_cast<std::size_t>(lanes); i < n; ++i) {
          expected[i] += expected[i - static_cast<std::size_t>(lanes)];
        }
        prefix_sum(values.data(), columns, lanes);
        ASSERT_EQ(values, expected) << test::simd_target_name(target) << ", " << columns << " columns";
      }
    }
  }
}

TEST(Sums, AddingRunsEqualsAddingValuesForAnyLengthAndTouchesNothingElse) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    for (std::size_t n = 0; n < 70; ++n) {
      const std::vector<Accumulator> values = random_values(n + 9);
      std::vector<Accumulator> sums = random_values(n + 8), expected = sums;
      for (std::size_t i = 0; i < n; ++i) expected[i] += values[i];
      add_sums(values.data(), n, sums.data());
      ASSERT_EQ(sums, expected) << test::simd_target_name(target) << ", " << n;
    }
  }
}

TEST(Sums, CopyingPastTheCachesCopiesAnyLengthAndTouchesNothingElse) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    for (std::size_t n = 0; n < 70; ++n) {
      const std::vector<Accumulator> values = random_values(n + 1);
      std::vector<Accumulator, CacheAligned<Accumulator>> sums(n + 9, 7);
      copy_sums_past_caches(values.data(), n, sums.data());
      finish_copies();
      for (std::size_t i = 0; i < sums.size(); ++i) {
        ASSERT_EQ(sums[i], i < n ? values[i] : 7) << test::simd_target_name(target) << ", " << n;
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
