#include "importance/waiting.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace pullfocus {

void WaitingTimes::of_row(std::size_t first, int n, std::uint16_t* out) const noexcept {
  if (since_.empty()) {
    std::fill_n(out, n, std::uint16_t{0});
    return;
  }
  const std::uint32_t *const since = &since_[first], next = calls_ + 1;
  for (int i = 0; i < n; ++i) {  // without branches: the compiler turns it into vectors
    const std::uint32_t calls = std::min(next - since[i], std::uint32_t{kMost});
    out[i] = static_cast<std::uint16_t>(since[i] != 0 ? calls : 0);
  }
}

// Only pixels that begin or cease to wait are written.
void WaitingTimes::update(const TileGrid& grid, const std::vector<TileWork>& left) {
  if (left.empty() && last_.empty()) return;
  since_.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  calls_ = left.empty() ? 0 : calls_ + 1;
  const auto set = [&](const std::vector<TileWork>& tiles, std::uint32_t since) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) {
        for_each_tile_pixel(grid, tiles[t], [&](int, int, int x, int y) {
          since_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x)] =
              since;
        });
      }
    });
  };
  set(without(last_, left), 0);
  set(without(left, last_), calls_);
  last_ = left;
}

void WaitingTimes::clear() noexcept {
  calls_ = 0;
  since_.clear();
  last_.clear();
}

}  // namespace pullfocus
