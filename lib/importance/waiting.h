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
  static constexpr int kMost = 0xffff;  // longer waits count as this

  int of(std::size_t pixel) const noexcept { return since_.empty() ? 0 : wait(since_[pixel]); }
  // Of n pixels from `first` on.
  void of_row(std::size_t first, int n, std::uint16_t* out) const noexcept;
  bool any() const noexcept { return !last_.empty(); }
  // No pixel waits longer.
  int most() const noexcept { return wait(any() ? 1 : 0); }

  // After a call: `left`, in grid order, is what it left over; all other pixels wait no longer. Runs in the calling
  // task arena.
  void update(const TileGrid& grid, const std::vector<TileWork>& left);
  void clear() noexcept;

 private:
  int wait(std::uint32_t since) const noexcept {
    if (since == 0) return 0;
    const std::uint32_t calls = calls_ - since + 1;
    return calls < kMost ? static_cast<int>(calls) : kMost;
  }

  std::uint32_t calls_ = 0;           // that left something over, in a row
  std::vector<std::uint32_t> since_;  // the first of them that left the pixel over; 0: does not wait
  std::vector<TileWork> last_;        // pixels that wait
};

}  // namespace pullfocus
