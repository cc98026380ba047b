#include "importance/select.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "importance/distance.h"

namespace pullfocus {

namespace {

// Buckets and edges of the pending change of single pixels.
template <SampleType type>
class PixelChange {
 public:
  PixelChange(const Pending& pending, const ImportanceOptions& options)
      : pending_(pending), options_(options), window_(pending.frame.window()) {}

  std::uint32_t position(int x, int y) const noexcept {
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(window_.width()) + static_cast<std::uint32_t>(x);
  }

  int bucket(int x, int y) const noexcept {
    const std::uint32_t at = position(x, y);
    const int was = pending_.state.index[at], is = pending_.index[at];
    if (was == kNeverCommitted) return kBuckets;  // before all others
    const double h_coc = coc_distance(pending_.kernels.coc(), was, is);
    return bucket_of(options_.w_coc * h_coc + options_.w_rgb * colour_change(x, y));
  }

 private:
  double colour_change(int x, int y) const noexcept {
    const auto load = [&](const ColourImage& image) {
      return load_pixel<type>(image.pixel(window_.x0 + x, window_.y0 + y));
    };
    return colour_distance<type>(load(pending_.state.colour), pending_.sanitiser(load(pending_.frame.colour)));
  }

  const Pending& pending_;
  const ImportanceOptions& options_;
  const Window window_;
};

TileGrid grid_of(const Pending& pending) noexcept {
  return {pending.frame.window().width(), pending.frame.window().height()};
}

// Calls visit(row of the tile, x, y) for every pixel of a tile's mask; x, y from the window's corner.
template <typename Visit>
void for_each_tile_pixel(const TileGrid& grid, const TileWork& work, Visit&& visit) {
  for (int i = 0; i < kTileHeight; ++i) {
    for_each_pixel(work.mask.rows[i], [&](int p) { visit(i, p, grid.x(work.tile) + p, grid.y(work.tile) + i); });
  }
}

// Bucket of every masked pixel, tile after tile.
std::vector<std::vector<std::uint8_t>> buckets_of(const std::vector<TileWork>& tiles, const Pending& pending,
                                                  const ImportanceOptions& options) {
  static_assert(kBuckets < 256);
  std::vector<std::vector<std::uint8_t>> buckets(tiles.size());
  const TileGrid grid = grid_of(pending);
  dispatch(pending.frame.colour.type(), [&]<SampleType type>() {
    const PixelChange<type> change(pending, options);
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
      for_each_tile_pixel(grid, tiles[t], [&](int, int, int x, int y) {
        buckets[t].push_back(static_cast<std::uint8_t>(change.bucket(x, y)));
      });
    });
  });
  return buckets;
}

std::int64_t edges_of(const KernelTable& kernels, int index) noexcept {
  return index == kNeverCommitted ? 0 : kernels.kernel(index).edge_count();
}

// Edges that taking over one pixel writes.
EdgeCount edges_of_pixel(const Pending& pending, std::size_t at) noexcept {
  const int was = pending.state.index[at], is = pending.index[at];
  const std::int64_t before = edges_of(pending.kernels, was), after = edges_of(pending.kernels, is);
  return {was == is ? after : before + after, after - before};
}

}  // namespace

namespace {

struct Candidate {
  std::uint64_t rank;  // importance, then scrambled position: no two are equal
  int waited;
  bool taken = false;
};

// All changed pixels, tile after tile.
std::vector<Candidate> candidates_of(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                     const WaitingTimes& waiting) {
  const TileGrid grid = grid_of(pending);
  const auto buckets = buckets_of(changes.tiles, pending, options);
  std::vector<Candidate> candidates;
  candidates.reserve(static_cast<std::size_t>(changes.pixels));
  for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
    std::size_t i = 0;
    for_each_tile_pixel(grid, changes.tiles[t], [&](int, int, int x, int y) {
      const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x;
      const std::uint64_t importance = buckets[t][i++];
      candidates.push_back({importance << 32 | ~scrambled(static_cast<std::uint32_t>(pixel)), waiting.of(pixel)});
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
    for_each_tile_pixel(grid_of(pending), changed, [&](int row, int p, int, int) {
      work.mask.rows[row] |= std::uint64_t{candidates[i++].taken} << p;
    });
    if (work.mask.any()) selected.push_back(work);
  }
  return selected;
}

std::vector<TileWork> merged(std::vector<TileWork> tiles) {
  std::sort(tiles.begin(), tiles.end(), [](const TileWork& a, const TileWork& b) { return a.tile < b.tile; });
  std::vector<TileWork> result;
  for (const TileWork& work : tiles) {
    if (result.empty() || result.back().tile != work.tile) {
      result.push_back(work);
      continue;
    }
    for (int i = 0; i < kTileHeight; ++i) result.back().mask.rows[i] |= work.mask.rows[i];
    result.back().max_index = std::max(result.back().max_index, work.max_index);
  }
  return result;
}

std::vector<TileWork> without(const std::vector<TileWork>& all, const std::vector<TileWork>& some) {
  std::vector<TileWork> rest;
  auto minus = some.begin();
  for (TileWork work : all) {
    while (minus != some.end() && minus->tile < work.tile) ++minus;
    if (minus != some.end() && minus->tile == work.tile) {
      for (int i = 0; i < kTileHeight; ++i) work.mask.rows[i] &= ~minus->mask.rows[i];
    }
    if (work.mask.any()) rest.push_back(work);
  }
  return rest;
}

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

EdgeCount count_edges(const std::vector<TileWork>& tiles, const Pending& pending) {
  const TileGrid grid = grid_of(pending);
  std::vector<EdgeCount> counts(tiles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      for_each_tile_pixel(grid, tiles[t], [&](int, int, int x, int y) {
        const EdgeCount pixel =
            edges_of_pixel(pending, static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x);
        counts[t].written += pixel.written;
        counts[t].committed += pixel.committed;
      });
    }
  });
  EdgeCount sum;
  for (const EdgeCount& count : counts) {
    sum.written += count.written;
    sum.committed += count.committed;
  }
  return sum;
}

std::vector<std::vector<TileWork>> cut_slices(const std::vector<TileWork>& tiles, const Pending& pending,
                                              const ImportanceOptions& options, std::int64_t most_edges) {
  const TileGrid grid = grid_of(pending);
  const auto buckets = buckets_of(tiles, pending, options);
  std::vector<std::size_t> order(tiles.size());
  std::vector<int> rank(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    order[t] = t;
    rank[t] = *std::max_element(buckets[t].begin(), buckets[t].end());
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank[a] > rank[b]; });

  std::vector<std::vector<TileWork>> slices;
  std::int64_t room = 0;
  for (const std::size_t t : order) {
    for (int i = 0; i < kTileHeight; ++i) {
      if (tiles[t].mask.rows[i] == 0) continue;
      std::int64_t edges = 0;
      const auto row = static_cast<std::size_t>(grid.y(tiles[t].tile) + i) * static_cast<std::size_t>(grid.width);
      for_each_pixel(tiles[t].mask.rows[i], [&](int p) {
        edges += edges_of_pixel(pending, row + static_cast<std::size_t>(grid.x(tiles[t].tile) + p)).written;
      });
      if (slices.empty() || edges > room) {
        slices.emplace_back();
        room = most_edges;
      }
      if (slices.back().empty() || slices.back().back().tile != tiles[t].tile) {
        slices.back().push_back({tiles[t].tile, tiles[t].max_index, {}});
      }
      slices.back().back().mask.rows[i] = tiles[t].mask.rows[i];
      room -= edges;
    }
  }
  return slices;
}

}  // namespace pullfocus
