// How sources are written as run edges: which values are made of their colours, and where these go. Made once for a
// kernel, or for the way from one kernel to another, and followed for every group of sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scatter/edge_pairs.h"
#include "scatter/kernel.h"

namespace pullfocus {

// Edges of one sign at columns dx, dx + 1, ... of row dy, with the value row of each. They are written in one pass over
// the columns they cover: a second pass over columns just written would wait for the first one's stores.
inline constexpr int kMaxChain = 4;
struct EdgeChain {
  std::int16_t dx, dy;
  std::uint8_t rows[kMaxChain];
};

// Chains of one length and sign: loops over them have no branches. Row by row.
struct ChainList {
  std::vector<EdgeChain> chains;
  std::vector<std::uint32_t> row_begin;  // of row dy, at dy + radius_y
};

// Value rows are numbers of all sources of a group at one kind of edge. They are counted on from weights to
// differences, sums and the row of zeros.
inline constexpr std::size_t kMostValueRows = 256;
struct RowPair {
  std::uint8_t a, b;
};

struct EdgePlan {
  int radius_y = 0;
  std::vector<double> weights;       // values: round(colour * weight), in units of 1 / kWeightUnit,
  std::size_t of_plus = 0;           // the first so many of what is added, the others of what is taken back, negated
  std::vector<RowPair> differences;  // a - b
  std::vector<RowPair> sums;         // a + b
  bool has_zeros = false;            // one more row, of zeros: for columns of chains without an edge
  ChainList chains[2][kMaxChain];    // by falling/rising and length - 1
  EdgePairs pairs;  // the same for single sources; empty in plans of moves, and where there are too many kinds

  std::size_t value_rows() const noexcept {
    return weights.size() + differences.size() + sums.size() + (has_zeros ? 1 : 0);
  }

  // Chains of rows [dy0, dy1), -radius_y <= dy0 <= dy1 <= radius_y + 1.
  std::span<const EdgeChain> rows(bool rising, int length, int dy0, int dy1) const noexcept {
    const ChainList& list = chains[rising][length - 1];
    const std::uint32_t begin = list.row_begin[static_cast<std::size_t>(dy0 + radius_y)];
    return {list.chains.data() + begin, list.row_begin[static_cast<std::size_t>(dy1 + radius_y)] - begin};
  }
};

// Adds what `kernel` spreads. Throws std::logic_error if its levels and steps are not fewer than kMostValueRows.
EdgePlan plan_of(const Kernel& kernel);

// Adds what `to` spreads and takes back what `from` does, in one pass: where kernels of nearly the same size have edges
// at the same or at neighbouring columns, these are written together. Two plans if one would need too many rows.
std::vector<EdgePlan> plans_of_move(const Kernel& from, const Kernel& to);

}  // namespace pullfocus
