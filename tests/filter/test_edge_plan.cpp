// Plans of edges against the kernels they are made of.
#include "scatter/edge_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "scatter/kernel_table.h"

namespace pullfocus {
namespace {

using Weights = std::map<std::pair<int, int>, std::int64_t>;  // by dx, dy

// A plan's value rows for colours of 1.
std::vector<std::int64_t> value_rows(const EdgePlan& plan) {
  std::vector<std::int64_t> rows;
  for (std::size_t k = 0; k < plan.weights.size(); ++k) {
    const auto weight = static_cast<std::int64_t>(plan.weights[k]);
    rows.push_back(k < plan.of_plus ? weight : -weight);
  }
  for (const RowPair& pair : plan.differences) rows.push_back(rows[pair.a] - rows[pair.b]);
  for (const RowPair& pair : plan.sums) rows.push_back(rows[pair.a] + rows[pair.b]);
  if (plan.has_zeros) rows.push_back(0);
  return rows;
}

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

void expect_equal(Weights a, Weights b) {
  std::erase_if(a, [](const auto& entry) { return entry.second == 0; });
  std::erase_if(b, [](const auto& entry) { return entry.second == 0; });
  ASSERT_EQ(a, b);
}

std::size_t chains(const EdgePlan& plan) {
  std::size_t sum = 0;
  for (const auto& lists : plan.chains) {
    for (const ChainList& list : lists) sum += list.chains.size();
  }
  return sum;
}

KernelOptions options_of(KernelShape::Kind kind) {
  KernelOptions options;
  options.max_coc_px = 60;
  options.shape.kind = kind;
  options.shape.blades = 5;
  return options;
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

// A value row for sources in one column: what it holds there and in the columns behind.
using Wide = std::array<std::int64_t, BlockPlan::kMostSpread + 1>;

int width_of(const Wide& row) {
  const auto last = std::find_if(row.rbegin(), row.rend(), [](std::int64_t value) { return value != 0; });
  return std::max(0, static_cast<int>(row.rend() - last) - 1);
}

// All value rows of a block whose source rows have the colours 1, 10, 100 ...
std::vector<Wide> rows_of_block(const BlockPlan& plan, const EdgePlan& of_row) {
  std::vector<Wide> rows;
  std::int64_t colour = 1;
  for (int h = 0; h < kBlockRows; ++h, colour *= 10) {
    for (const std::int64_t value : value_rows(of_row)) rows.push_back({value * colour});
  }
  const auto add_sum = [&rows](const BlockPlan::RowSum& sum) {
    Wide row = rows.at(sum.a);
    EXPECT_LE(sum.shift + width_of(rows.at(sum.b)), BlockPlan::kMostSpread);
    for (std::size_t i = sum.shift; i < row.size(); ++i) row[i] += rows.at(sum.b)[i - sum.shift];
    rows.push_back(row);
  };
  for (const BlockPlan::RowSum& sum : plan.sums) {
    EXPECT_EQ(sum.shift, 0);
    add_sum(sum);
  }
  EXPECT_EQ(rows.size(), plan.value_rows());
  rows.resize(BlockPlan::kMostRows);
  for (const BlockPlan::RowSum& sum : plan.wide) {
    add_sum(sum);
    EXPECT_LE(width_of(rows[rows.size() - 2]), width_of(rows.back()));
  }
  return rows;
}

void expect_groups_share_their_term(const BlockPlan::Chains& list) {
  std::size_t next = 0;
  for (const std::uint16_t size : list.groups) {
    ASSERT_GT(size, 0);
    ASSERT_LE(next + size, list.chains.size());
    for (std::size_t i = next; i < next + size; ++i) {
      ASSERT_EQ(list.chains[i].added + list.chains[i].taken, 1);
      ASSERT_EQ(list.chains[i].taken, list.chains[next].taken);
      ASSERT_EQ(int{list.terms[i].row}, int{list.terms[next].row});
      ASSERT_EQ(int{list.terms[i].shift}, int{list.terms[next].shift});
    }
    next += size;
  }
}

// By column and row.
Weights edges_of_block(const BlockPlan& plan, const EdgePlan& of_row) {
  const std::vector<Wide> rows = rows_of_block(plan, of_row);
  Weights edges;
  for (int spread = 0; spread < BlockPlan::kSpreads; ++spread) {
    expect_groups_share_their_term(plan.of_spread[spread]);
    std::size_t next = 0;
    for (const BlockChain& chain : plan.of_spread[spread].chains) {
      for (int t = 0; t < chain.added + chain.taken; ++t) {
        const BlockTerm& term = plan.of_spread[spread].terms.at(next++);
        const Wide& row = rows.at(term.row);
        EXPECT_LE(term.shift + width_of(row), spread * BlockPlan::kSpreadStep);
        for (int i = 0; i <= width_of(row); ++i) {
          edges[{chain.dx + term.shift + i, chain.dy}] += (t < chain.added ? 1 : -1) * row[static_cast<std::size_t>(i)];
        }
      }
    }
    EXPECT_EQ(next, plan.of_spread[spread].terms.size());
  }
  return edges;
}

Weights edges_of_rows(const EdgePlan& plan) {
  const std::vector<std::int64_t> rows = value_rows(plan);
  Weights edges;
  std::int64_t colour = 1;
  for (int h = 0; h < kBlockRows; ++h, colour *= 10) {
    for (const bool rising : {false, true}) {
      for (int length = 1; length <= kMaxChain; ++length) {
        for (const EdgeChain& chain : plan.rows(rising, length, -plan.radius_y, plan.radius_y + 1)) {
          for (int k = 0; k < length; ++k) {
            edges[{chain.dx + k, chain.dy + h}] += (rising ? 1 : -1) * colour * rows[chain.rows[k]];
          }
        }
      }
    }
  }
  return edges;
}

TEST_P(EdgePlans, OfBlocksGiveWhatTheirRowsGive) {
  const KernelTable table(options_of(GetParam()));
  int blocks = 0;
  for (int index = 1 - table.coc().size(); index + 1 < table.coc().size(); ++index) {
    const EdgePlan &row = table.plan(index), &way = table.move(index, index + 1)[0];
    for (const CommonSums sums : {CommonSums::ignored, CommonSums::found}) {
      const BlockPlan block = block_plan_of(row, sums), move = block_plan_of(way, sums);
      if (!block.empty()) expect_equal(edges_of_block(block, row), edges_of_rows(row));
      if (!move.empty()) expect_equal(edges_of_block(move, way), edges_of_rows(way));
      ASSERT_FALSE(HasFatalFailure()) << "index " << index;
      ASSERT_LE(block.value_rows(), BlockPlan::kMostRows);
      ASSERT_LE(block.wide.size(), sums == CommonSums::found ? BlockPlan::kMostWide : 0);
      blocks += !block.empty();
    }
  }
  EXPECT_GT(blocks, 0);
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

// Four rows of a disc have edges at 8 places in a row of the picture, or fewer: they are written as 2 to 4 chains.
TEST(EdgePlan, OfABlockReadsAndWritesAThirdOfWhatRowsDo) {
  const KernelTable table(options_of(KernelShape::Kind::disc));
  for (int index = 10; index < table.coc().size(); ++index) {
    const BlockPlan block = block_plan_of(table.plan(index), CommonSums::found);
    std::size_t written = 0;
    for (const auto& of_spread : block.of_spread) written += of_spread.chains.size();
    EXPECT_LE(3 * written, 1.25 * kBlockRows * static_cast<double>(chains(table.plan(index)))) << index;
    EXPECT_FALSE(block.empty()) << index;
    EXPECT_LT(block.cost, BlockPlan::kAllRows) << index;
  }
}

// Four rows of a solid disc have 2.3 terms a chain, of which most are as far apart in other chains.
TEST(EdgePlan, OfABlockAddsTermsThatManyChainsHaveOnce) {
  const KernelTable table(options_of(KernelShape::Kind::disc));
  int solid = 0;
  for (int index = 10; index < table.coc().size(); ++index) {
    if (table.kernel(index).levels.size() > 2) continue;
    const BlockPlan block = block_plan_of(table.plan(index), CommonSums::found);
    std::size_t chains = 0, terms = 0;
    for (const auto& of_spread : block.of_spread) {
      chains += of_spread.chains.size();
      terms += of_spread.terms.size();
    }
    EXPECT_LE(static_cast<double>(terms), 1.6 * static_cast<double>(chains)) << index;
    ++solid;
  }
  EXPECT_GT(solid, 0);
}

TEST(EdgePlan, OfABlockIsMadeWhenAskedForOften) {
  const KernelTable table(options_of(KernelShape::Kind::disc));
  for (int i = 0; i < KernelTable::kAskedForBlock; ++i) {
    EXPECT_TRUE(table.block(20).empty());
    EXPECT_TRUE(table.block_move(40, 41).empty());
  }
  EXPECT_FALSE(table.block(20).empty());
  EXPECT_TRUE(table.block(20).wide.empty());
  for (int i = KernelTable::kAskedForBlock; i < KernelTable::kAskedForSums; ++i) table.block(20);
  EXPECT_FALSE(table.block(20).wide.empty());
  EXPECT_EQ(&table.block(20), &table.block(-20));
  EXPECT_FALSE(table.block_move(40, 41).empty());
  EXPECT_TRUE(table.block_move(41, 40).empty());
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
