// How blocks of sources that share a kernel are written: several rows of them at once. In one row of the picture the
// edges of neighbouring source rows fall on the same or on near columns, so that the accumulators there, which come
// from the outer caches, are read and written once for all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scatter/edge_plan.h"

namespace pullfocus {

// As large as lets the value rows of most kernels stay in the innermost cache.
inline constexpr int kBlockRows = 4, kBlockColumns = 16;

// Value row `row` is added (or taken) `shift` columns behind the chain's first. Small, since plans of all sizes compete
// for the caches.
struct BlockTerm {
  std::uint16_t row : 12, shift : 4;
  bool operator==(const BlockTerm&) const = default;
};

// Edges of all source rows at columns dx .. dx + spread of row dy, counted from the block's first row: so many of the
// plan's terms, which follow each other chain by chain, those that are added first.
struct BlockChain {
  std::int16_t dx, dy;
  std::uint8_t added, taken;
};

struct BlockPlan {
  // Spreads are rounded up; what a chain covers beyond its edges is written as it was.
  static constexpr int kSpreadStep = 2;
  static constexpr int kSpreads = 3;
  static constexpr int kMostSpread = (kSpreads - 1) * kSpreadStep;
  static constexpr std::size_t kMostRows = 512, kMostWide = 128;

  // a[x] + b[x - shift]
  struct RowSum {
    std::uint16_t a, b;
    std::uint8_t shift;
    bool operator==(const RowSum&) const = default;
  };
  struct Chains {
    std::vector<BlockChain> chains;
    std::vector<BlockTerm> terms;
    // The first chains have one term each, so many in turn the same one with the same sign. The others come row by row.
    std::vector<std::uint16_t> groups;
  };

  int radius_y = 0;  // chains have rows -radius_y .. radius_y + kBlockRows - 1
  // Row k of the edge plan for source row h is value row h * rows_a_line + k; behind them come sums without shifts.
  // Wide rows, from kMostRows on, are sums that take up to kMostSpread columns more: none is wider than the next one.
  std::size_t rows_a_line = 0;
  std::vector<RowSum> sums, wide;
  Chains of_spread[kSpreads];

  // A whole block's cost in proportion to that of its rows one by one, of kAllRows.
  static constexpr int kAllRows = 64;
  int cost = 0;

  std::size_t value_rows() const noexcept { return kBlockRows * rows_a_line + sums.size(); }  // without wide ones
  bool empty() const noexcept { return rows_a_line == 0; }
};

enum class CommonSums { ignored, found };

// Writes what `plan` does for each of kBlockRows rows. Empty if that takes more than kMostRows value rows, or more time
// than writing the rows one by one. Wide rows are made where common sums are to be found.
BlockPlan block_plan_of(const EdgePlan& plan, CommonSums sums);

}  // namespace pullfocus
