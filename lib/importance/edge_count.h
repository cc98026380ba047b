// How many run edges a change writes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "image/tiles.h"
#include "scatter/kernel_table.h"
#include "scatter/state.h"

namespace pullfocus {

// Edges to write for a set of pixels, and what the set changes of the edge count of the committed state.
struct EdgeCount {
  std::int64_t written = 0;    // one scatter for a change of colour, two for a change of index
  std::int64_t moved = 0;      // of them, those of a change to a near index, which writes both kernels in one pass
  std::int64_t committed = 0;  // difference of the committed state's own edges

  void add(const EdgeCount& other) noexcept {
    written += other.written;
    moved += other.moved;
    committed += other.committed;
  }
};

// Of one pixel that goes from a signed index to another, or changes its colour alone.
inline EdgeCount edges_of_change(const KernelTable& kernels, std::int16_t was, std::int16_t is) noexcept {
  const std::int64_t before = kernels.edge_count(was), after = kernels.edge_count(is);
  if (was == is) return {after, 0, 0};
  const bool near = is_source(was) && is_source(is) && std::abs(is - was) <= KernelTable::kFarthestMove;
  return {before + after, near ? before + after : 0, after - before};
}

// Of the pixels `mask` of a tile row of n pixels.
inline EdgeCount edges_of_row(const KernelTable& kernels, const std::int16_t* was, const std::int16_t* is,
                              std::uint64_t mask, int n) noexcept {
  EdgeCount count;
  if (mask != first_pixels(n)) {
    for_each_pixel(mask, [&](int p) { count.add(edges_of_change(kernels, was[p], is[p])); });
  } else if (std::equal(was, was + n, is)) {
    for (int p = 0; p < n; ++p) count.written += kernels.edge_count(is[p]);
  } else {
    for (int p = 0; p < n; ++p) count.add(edges_of_change(kernels, was[p], is[p]));
  }
  return count;
}

}  // namespace pullfocus
