// Shots that break float sums: the filter holds the true sums, stays within its rounding, and comes back to the bit.
#include <gtest/gtest.h>

#include "hard_shots.h"

namespace pullfocus {
namespace {

class HardCase : public testing::TestWithParam<test::HardShot> {};

TEST_P(HardCase, KeepsTrueSumsFiniteColoursAndReturnsToTheSameBits) {
  const test::Comparison is = test::compare(GetParam(), 2);
  EXPECT_TRUE(is.exact) << "the sums are not those of 128-bit integers";
  EXPECT_EQ(is.filter.not_finite, 0);
  EXPECT_LE(is.share_of_bound, 1) << "error beyond half a unit a contribution and half a unit in the last place";
  EXPECT_TRUE(is.filter.same_bits) << "frame 0 does not give its own bits again";
}

std::string name_of(const testing::TestParamInfo<test::HardShot>& info) {
  std::string name;
  for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shots, HardCase, testing::ValuesIn(test::hard_shots()), name_of);

}  // namespace
}  // namespace pullfocus
