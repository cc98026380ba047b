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

// How many calls in a row a pixel's change has been left over, by pixel; empty until something is left over for the
// first time.
class WaitingTimes {
 public:
  int of(std::size_t pixel) const noexcept { return waited_.empty() ? 0 : waited_[pixel]; }

  // After a call: `left` is what it left over; all other pixels wait no longer.
  void update(const TileGrid& grid, const std::vector<TileWork>& left);
  void clear() noexcept;

 private:
  std::vector<std::uint16_t> waited_;
  std::vector<TileWork> last_;  // pixels that wait
};

// What a budget affords.
struct Allowance {
  std::int64_t pixels = 0;  // half of them go to those that wait longest, if any wait
  int longest_wait = 0;     // a pixel that has waited so many calls is served in any case; 0: no such promise
};

// The changed pixels to update: the half of the allowance that serves those that have waited longest, and for the
// rest of it the most important ones. Ties go by importance, then by scrambled position. Deterministic, whatever the
// threads. Pixels never committed are more important than all others.
std::vector<TileWork> select_pixels(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                    const WaitingTimes& waiting, const Allowance& allowance);

// The same pixels in grid order, each tile once.
std::vector<TileWork> merged(std::vector<TileWork> tiles);

// Pixels of `all` that are not in `some`; both in grid order.
std::vector<TileWork> without(const std::vector<TileWork>& all, const std::vector<TileWork>& some);

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
