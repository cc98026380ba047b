// What plans of edges are held against, and by: weights by column and row.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scatter/edge_plan.h"
#include "scatter/kernel_table.h"

namespace pullfocus::test {

using Weights = std::map<std::pair<int, int>, std::int64_t>;  // by dx, dy

// A plan's value rows for colours of 1.
inline std::vector<std::int64_t> value_rows(const EdgePlan& plan) {
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

inline void expect_equal(Weights a, Weights b) {
  std::erase_if(a, [](const auto& entry) { return entry.second == 0; });
  std::erase_if(b, [](const auto& entry) { return entry.second == 0; });
  ASSERT_EQ(a, b);
}

inline std::size_t chains(const EdgePlan& plan) {
  std::size_t sum = 0;
  for (const auto& lists : plan.chains) {
    for (const ChainList& list : lists) sum += list.chains.size();
  }
  return sum;
}

inline KernelOptions options_of(KernelShape::Kind kind) {
  KernelOptions options;
  options.max_coc_px = 60;
  options.shape.kind = kind;
  options.shape.blades = 5;
  return options;
}

}  // namespace pullfocus::test
