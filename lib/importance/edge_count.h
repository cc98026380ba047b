// How many run edges a change writes.
#pragma once

#include <cstdint>

#include "image/tiles.h"
#include "scatter/kernel_table.h"

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
  void subtract(const EdgeCount& other) noexcept {
    written -= other.written;
    moved -= other.moved;
    committed -= other.committed;
  }
};

// Of the pixels `mask` of a tile row of n pixels (n <= kTileWidth, no bit of the mask beyond): each goes from a signed
// index to another, or changes its colour alone. SIMD with run-time dispatch.
EdgeCount edges_of_row(const KernelTable& kernels, const std::int16_t* was, const std::int16_t* is, std::uint64_t mask,
                       int n) noexcept;

// Of the sources among n signed indices (0 <= n <= kTileWidth): the run edges of their kernels. What edges_of_row()
// finds committed if nothing was before, in half the time.
std::int64_t edges_of(const KernelTable& kernels, const std::int16_t* index, int n) noexcept;

}  // namespace pullfocus
