// When a rebuild keeps its sums: what that costs at most, in shots of any mixture.
#include "filter/keep_rule.h"

#include <gtest/gtest.h>

namespace pullfocus {
namespace {

// Sums missed over a shot in which `rebuilds` full changes and one small change take turns.
int misses(int rebuilds, int frames) {
  KeepRule rule;
  bool kept = true;
  int missed = 0;
  for (int frame = 0; frame < frames; ++frame) {
    if (frame % (rebuilds + 1) < rebuilds) {
      kept = rule.keeps();
      rule.rebuilt(kept);
    } else {
      missed += !kept;
      rule.updated(!kept);
      kept = true;
    }
  }
  return missed;
}

TEST(KeepRule, MissesSumsAFewTimesAtMostWhereFullAndSmallChangesTakeTurns) {
  EXPECT_EQ(misses(1, 1000), 0);
  for (int rebuilds = 2; rebuilds <= 8; ++rebuilds) EXPECT_LE(misses(rebuilds, 1000), 4) << rebuilds;
  // Longer runs of rebuilds save more than is lost.
  for (int rebuilds = 9; rebuilds <= 200; ++rebuilds) {
    EXPECT_LE(misses(rebuilds, 10000) * (rebuilds + 1), 10000) << rebuilds;
  }
}

TEST(KeepRule, KeepsTheFirstOfAShotOfRebuildsOnly) {
  KeepRule rule;
  for (int frame = 0; frame < 1000; ++frame) {
    ASSERT_EQ(rule.keeps(), frame == 0);
    rule.rebuilt(rule.keeps());
  }
}

TEST(KeepRule, FindsBackToForgettingAfterMisses) {
  KeepRule rule;
  for (int miss = 0; miss < 20; ++miss) rule.updated(true);
  int kept = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    kept += rule.keeps();
    rule.rebuilt(rule.keeps());
  }
  EXPECT_EQ(kept, 64);
  rule.updated(false);
  EXPECT_TRUE(rule.keeps());
  rule.rebuilt(true);
  EXPECT_FALSE(rule.keeps());
}

}  // namespace
}  // namespace pullfocus
