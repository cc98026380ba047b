#include "importance/waiting.h"

namespace pullfocus {

void WaitingTimes::update(const TileGrid& grid, const std::vector<TileWork>& left) {
  if (left.empty() && last_.empty()) return;
  waited_.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  const auto at = [&](int x, int y) -> std::uint16_t& {
    return waited_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x];
  };
  for (const TileWork& work : without(last_, left)) {
    for_each_tile_pixel(grid, work, [&](int, int, int x, int y) { at(x, y) = 0; });
  }
  for (const TileWork& work : left) {
    for_each_tile_pixel(grid, work, [&](int, int, int x, int y) {
      if (at(x, y) < 0xffff) ++at(x, y);
    });
  }
  last_ = left;
}

void WaitingTimes::clear() noexcept {
  waited_.clear();
  last_.clear();
}

}  // namespace pullfocus
