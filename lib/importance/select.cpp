#include "importance/select.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

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
    const CocTable& coc = pending_.kernels.coc();
    const double h_coc = std::fabs(std::copysign(coc.diameter(is), is) - std::copysign(coc.diameter(was), was));
    return bucket_of(options_.w_coc * h_coc + options_.w_rgb * colour_distance(x, y));
  }

 private:
  double colour_distance(int x, int y) const noexcept {
    const auto load = [&](const ColourImage& image) {
      return load_pixel<type>(image.pixel(window_.x0 + x, window_.y0 + y));
    };
    const Pixel<type> was = load(pending_.state.colour), is = pending_.sanitiser(load(pending_.frame.colour));
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = static_cast<double>(sample_value(is.rgba[c])) - static_cast<double>(sample_value(was.rgba[c]));
      sum += d * d;
    }
    return std::sqrt(sum);
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

std::vector<TileWork> select_most_important(const Changes& changes, const Pending& pending,
                                            const ImportanceOptions& options, std::int64_t most) {
  if (most >= changes.pixels) return changes.tiles;
  const TileGrid grid = grid_of(pending);
  const auto buckets = buckets_of(changes.tiles, pending, options);

  std::vector<std::int64_t> histogram(kBuckets + 1);
  for (const auto& tile : buckets) {
    for (const std::uint8_t b : tile) ++histogram[b];
  }
  int last = kBuckets;
  std::int64_t left = most;
  while (last > 0 && histogram[static_cast<std::size_t>(last)] <= left) {
    left -= histogram[static_cast<std::size_t>(last--)];
  }

  // The last bucket is served in part: the `left` first by scrambled position.
  const auto position = [&](int x, int y) {
    return scrambled(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(grid.width) +
                     static_cast<std::uint32_t>(x));
  };
  std::vector<std::uint32_t> ties;
  for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
    std::size_t i = 0;
    for_each_tile_pixel(grid, changes.tiles[t], [&](int, int, int x, int y) {
      if (buckets[t][i++] == last) ties.push_back(position(x, y));
    });
  }
  const bool some = left > 0;
  if (some) std::nth_element(ties.begin(), ties.begin() + (left - 1), ties.end());
  const std::uint32_t last_position = some ? ties[static_cast<std::size_t>(left - 1)] : 0;

  std::vector<TileWork> selected;
  for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
    TileWork work{changes.tiles[t].tile, changes.tiles[t].max_index, {}};
    std::size_t i = 0;
    for_each_tile_pixel(grid, changes.tiles[t], [&](int row, int p, int x, int y) {
      const int bucket = buckets[t][i++];
      const bool take = bucket > last || (some && bucket == last && position(x, y) <= last_position);
      work.mask.rows[row] |= std::uint64_t{take} << p;
    });
    if (work.mask.any()) selected.push_back(work);
  }
  return selected;
}

EdgeCount count_edges(const std::vector<TileWork>& tiles, const Pending& pending) {
  const TileGrid grid = grid_of(pending);
  std::vector<EdgeCount> counts(tiles.size());
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
    for_each_tile_pixel(grid, tiles[t], [&](int, int, int x, int y) {
      const EdgeCount pixel =
          edges_of_pixel(pending, static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x);
      counts[t].written += pixel.written;
      counts[t].committed += pixel.committed;
    });
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
