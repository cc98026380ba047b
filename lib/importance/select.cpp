#include "importance/select.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

namespace pullfocus {

namespace {

struct Candidate {
  std::uint64_t rank;  // priority, then scrambled position: no two are equal
  int waited;
  bool taken = false;
};

// All changed pixels, tile after tile.
std::vector<Candidate> candidates_of(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                     const WaitingTimes& waiting) {
  const TileGrid grid = grid_of(pending.frame.window());
  const auto of_tile = priorities(changes.tiles, pending, options);
  const std::uint32_t round = scrambled(pending.round);
  std::vector<Candidate> candidates;
  candidates.reserve(static_cast<std::size_t>(changes.pixels));
  for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
    std::size_t i = 0;
    for_each_tile_pixel(grid, changes.tiles[t], [&](int, int, int x, int y) {
      const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x;
      // Bits of floats >= 0 order as the floats do.
      const std::uint64_t priority = std::bit_cast<std::uint32_t>(of_tile[t][i++]);
      candidates.push_back({priority << 32 | scrambled(static_cast<std::uint32_t>(pixel) ^ round), waiting.of(pixel)});
    });
  }
  return candidates;
}

// Takes the n candidates not yet taken that `eligible` lets in and that have the largest keys; returns how many.
template <typename Eligible, typename Key>
std::int64_t take_largest(std::vector<Candidate>& candidates, std::int64_t n, Eligible&& eligible, Key&& key) {
  std::vector<decltype(key(candidates[0]))> keys;
  for (const Candidate& c : candidates) {
    if (!c.taken && eligible(c)) keys.push_back(key(c));
  }
  n = std::min(n, static_cast<std::int64_t>(keys.size()));
  if (n <= 0) return 0;
  std::nth_element(keys.begin(), keys.begin() + (n - 1), keys.end(), std::greater<>());
  const auto smallest = keys[static_cast<std::size_t>(n - 1)];
  for (Candidate& c : candidates) c.taken |= eligible(c) && key(c) >= smallest;
  return n;
}

}  // namespace

std::vector<TileWork> select_pixels(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                    const WaitingTimes& waiting, const Allowance& allowance) {
  if (allowance.pixels >= changes.pixels) return changes.tiles;
  std::vector<Candidate> candidates = candidates_of(changes, pending, options, waiting);

  std::int64_t left = allowance.pixels;
  const std::int64_t oldest_share = (allowance.pixels + 1) / 2;
  left -= take_largest(
      candidates, oldest_share, [](const Candidate& c) { return c.waited > 0; },
      [](const Candidate& c) { return std::pair(c.waited, c.rank); });
  take_largest(
      candidates, left, [](const Candidate&) { return true; }, [](const Candidate& c) { return c.rank; });
  if (allowance.longest_wait > 0) {
    for (Candidate& c : candidates) c.taken |= c.waited >= allowance.longest_wait;
  }

  std::vector<TileWork> selected;
  std::size_t i = 0;
  for (const TileWork& changed : changes.tiles) {
    TileWork work{changed.tile, changed.max_index, {}};
    for_each_tile_pixel(grid_of(pending.frame.window()), changed, [&](int row, int p, int, int) {
      work.mask.rows[row] |= std::uint64_t{candidates[i++].taken} << p;
    });
    if (work.mask.any()) selected.push_back(work);
  }
  return selected;
}

}  // namespace pullfocus
