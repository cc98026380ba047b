// Plans of blocks against those of their rows.
#include "scatter/block_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "plan_weights.h"

namespace pullfocus {
namespace {

using test::chains;
using test::expect_equal;
using test::options_of;
using test::value_rows;
using test::Weights;

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

class BlockPlans : public testing::TestWithParam<KernelShape::Kind> {};

TEST_P(BlockPlans, GiveWhatTheirRowsGive) {
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

INSTANTIATE_TEST_SUITE_P(Shapes, BlockPlans,
                         testing::Values(KernelShape::Kind::disc, KernelShape::Kind::polygon,
                                         KernelShape::Kind::gaussian, KernelShape::Kind::diffraction));

// Four rows of a disc have edges at 8 places in a row of the picture, or fewer: they are written as 2 to 4 chains.
TEST(BlockPlan, ReadsAndWritesAThirdOfWhatRowsDo) {
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
TEST(BlockPlan, AddsTermsThatManyChainsHaveOnce) {
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

TEST(BlockPlan, IsMadeWhenAskedForOften) {
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

}  // namespace
}  // namespace pullfocus
