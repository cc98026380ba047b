// How long changes have been left over.
#pragma once

#include <cstdint>
#include <vector>

#include "importance/tile_sets.h"

namespace pullfocus {

// How many calls in a row a pixel's change has been left over, by pixel; empty until something is left over for the
// first time.
class WaitingTimes {
 public:
  int of(std::size_t pixel) const noexcept { return waited_.empty() ? 0 : waited_[pixel]; }
  bool any() const noexcept { return !last_.empty(); }

  // After a call: `left` is what it left over; all other pixels wait no longer.
  void update(const TileGrid& grid, const std::vector<TileWork>& left);
  void clear() noexcept;

 private:
  std::vector<std::uint16_t> waited_;
  std::vector<TileWork> last_;  // pixels that wait
};

}  // namespace pullfocus
