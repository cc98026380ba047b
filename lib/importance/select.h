// Which of the changed pixels a budget affords, the most important first, and in which slices to do them.
#pragma once

#include <cstdint>
#include <vector>

#include "importance/change.h"
#include "importance/importance.h"

namespace pullfocus {

// Everything importance is computed from.
struct Pending {
  const Frame& frame;
  const SourceState& state;
  const std::vector<std::int16_t>& index;  // of the frame, where changed
  const KernelTable& kernels;
  const Sanitiser& sanitiser;
};

// The `most` most important of the changed pixels: all of the higher buckets, and of the last one those that
// come first by scrambled position. Deterministic, whatever the threads. Pixels never committed come before
// all others.
std::vector<TileWork> select_most_important(const Changes& changes, const Pending& pending,
                                            const ImportanceOptions& options, std::int64_t most);

// Edges to write for a set of pixels, and what the set changes of the edge count of the committed state.
struct EdgeCount {
  std::int64_t written = 0;    // one scatter for a change of colour, two for a change of index
  std::int64_t committed = 0;  // difference of the committed state's own edges
};
EdgeCount count_edges(const std::vector<TileWork>& tiles, const Pending& pending);

// Cuts a selection into slices of at most about `most_edges` edges each (at least one tile row), tiles with
// the most important pixel first.
std::vector<std::vector<TileWork>> cut_slices(const std::vector<TileWork>& tiles, const Pending& pending,
                                              const ImportanceOptions& options, std::int64_t most_edges);

}  // namespace pullfocus
