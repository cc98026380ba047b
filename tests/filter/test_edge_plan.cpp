// Plans of edges against the kernels they are made of.
#include "scatter/edge_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "plan_weights.h"

namespace pullfocus {
namespace {

using test::chains;
using test::expect_equal;
using test::options_of;
using test::value_rows;
using test::Weights;

// What a plan gives for colours of 1: every value row in turn, edges to differences, differences to weights.
void follow(const EdgePlan& plan, Weights& weights) {
  const std::vector<std::int64_t> rows = value_rows(plan);
  ASSERT_EQ(rows.size(), plan.value_rows());
  ASSERT_LE(rows.size(), kMostValueRows);
  Weights edges;
  for (const bool rising : {false, true}) {
    for (int length = 1; length <= kMaxChain; ++length) {
      for (const EdgeChain& chain : plan.rows(rising, length, -plan.radius_y, plan.radius_y + 1)) {
        for (int k = 0; k < length; ++k) {
          ASSERT_LT(chain.rows[k], rows.size());
          edges[{chain.dx + k, chain.dy}] += (rising ? 1 : -1) * rows[chain.rows[k]];
        }
      }
    }
  }
  for (int dy = -plan.radius_y; dy <= plan.radius_y; ++dy) {
    std::int64_t sum = 0;
    for (int dx = -80; dx <= 80; ++dx) {
      const auto edge = edges.find({dx, dy});
      if (edge != edges.end()) sum += edge->second;
      weights[{dx, dy}] += sum;
    }
    ASSERT_EQ(sum, 0) << "row " << dy;
  }
}

void add(const Kernel& kernel, int sign, Weights& weights) {
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) weights[{dx, dy}] += sign * kernel.weight(dx, dy);
  }
}

class EdgePlans : public testing::TestWithParam<KernelShape::Kind> {};

TEST_P(EdgePlans, GiveWhatTheirKernelGives) {
  const KernelTable table(options_of(GetParam()));
  for (int index = 1 - table.coc().size(); index < table.coc().size(); ++index) {
    Weights planned, given;
    follow(table.plan(index), planned);
    add(table.kernel(index), 1, given);
    expect_equal(planned, given);
    ASSERT_FALSE(HasFatalFailure()) << "index " << index;
  }
}

TEST_P(EdgePlans, OfSingleSourcesGiveWhatTheirKernelGives) {
  const KernelTable table(options_of(GetParam()));
  for (int index = 0; index < table.coc().size(); ++index) {
    const Kernel& kernel = table.kernel(index);
    const EdgePairs pairs = pairs_of(kernel);
    ASSERT_FALSE(pairs.empty()) << index;
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      std::vector<std::int64_t> row(static_cast<std::size_t>(2 * kernel.radius_x + 4));
      for (const int columns : {1, 2}) {
        for (const EdgePair& pair : pairs.rows(columns, dy, dy + 1)) {
          ASSERT_EQ(pair.dy, dy);
          const LevelPair& kind = pairs.kinds[pair.kind];
          const auto at = static_cast<std::size_t>(pair.dx + kernel.radius_x);
          row[at] += kernel.levels[kind.first] - kernel.levels[kind.before];
          ASSERT_TRUE(columns == 2 || kind.second == kind.first);
          row[at + 1] += kernel.levels[kind.second] - kernel.levels[kind.first];
        }
      }
      std::int64_t sum = 0;
      for (int dx = -kernel.radius_x; dx <= kernel.radius_x + 1; ++dx) {
        sum += row[static_cast<std::size_t>(dx + kernel.radius_x)];
        ASSERT_EQ(sum, kernel.weight(dx, dy)) << index << ": " << dx << ", " << dy;
      }
    }
  }
}

TEST_P(EdgePlans, OfMovesGiveTheNewKernelLessTheOldOne) {
  const KernelTable table(options_of(GetParam()));
  const int last = table.coc().size() - 1;
  for (int from = -last; from <= last; from += 3) {
    for (const int by : {-KernelTable::kFarthestMove, -1, 1, 2, KernelTable::kFarthestMove}) {
      const int to = from + by;
      if (std::abs(to) > last) continue;
      Weights planned, given;
      for (const EdgePlan& plan : table.move(from, to)) follow(plan, planned);
      add(table.kernel(to), 1, given);
      add(table.kernel(from), -1, given);
      expect_equal(planned, given);
      ASSERT_FALSE(HasFatalFailure()) << from << " to " << to;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EdgePlans,
                         testing::Values(KernelShape::Kind::disc, KernelShape::Kind::polygon,
                                         KernelShape::Kind::gaussian, KernelShape::Kind::diffraction));

TEST(EdgePlan, WritesTheEdgesOfNeighbouringDiscsTogether) {
  const KernelTable table(options_of(KernelShape::Kind::disc));
  for (int index = 10; index + 1 < table.coc().size(); ++index) {
    const std::size_t apart = chains(table.plan(index)) + chains(table.plan(index + 1));
    ASSERT_EQ(table.move(index, index + 1).size(), 1u);
    EXPECT_LE(chains(table.move(index, index + 1)[0]), 0.62 * static_cast<double>(apart)) << index;
  }
}

// Noise of 16 levels has all pairs of them as edges: two kernels need more value rows than there are.
TEST(EdgePlan, IsSplitWhereTwoKernelsNeedTooManyRows) {
  std::mt19937 random(6);
  const auto noise = [&] {
    std::vector<std::int32_t> shares;
    for (int i = 0; i < 41 * 41; ++i) shares.push_back(static_cast<std::int32_t>(random() % 17));
    return kernel_from_shares(20, 20, shares);
  };
  const Kernel from = noise(), to = noise();
  const std::vector<EdgePlan> plans = plans_of_move(from, to);
  ASSERT_EQ(plans.size(), 2u);
  Weights planned, given;
  for (const EdgePlan& plan : plans) follow(plan, planned);
  add(to, 1, given);
  add(from, -1, given);
  expect_equal(planned, given);
}

// Edges of any two levels meet at every column: sums run out of rows, and the rest is written apart.
TEST(EdgePlan, StaysRightWhereSumsRunOutOfRows) {
  std::mt19937 random(7);
  const auto blocks = [&] {
    std::vector<std::int32_t> shares;
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 41; ++x) shares.push_back(x % 2 ? 0 : static_cast<std::int32_t>(random() % 17));
    }
    return kernel_from_shares(20, 20, shares);
  };
  const Kernel from = blocks(), to = blocks();
  const std::vector<EdgePlan> plans = plans_of_move(from, to);
  ASSERT_EQ(plans.size(), 1u);
  Weights planned, given;
  follow(plans[0], planned);
  EXPECT_GE(plans[0].weights.size() + plans[0].differences.size() + plans[0].sums.size(), kMostValueRows - 2);
  add(to, 1, given);
  add(from, -1, given);
  expect_equal(planned, given);
}

}  // namespace
}  // namespace pullfocus
