#include "importance/slices.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "importance/tile_row.h"

namespace pullfocus {

namespace {

EdgeCount edges_of_tile(const TileGrid& grid, const TileWork& work, const Pending& pending) noexcept {
  EdgeCount count;
  for (int i = 0; i < kTileHeight; ++i) {
    if (work.mask.rows[i] == 0) continue;
    const std::size_t first = position(grid, grid.x(work.tile), grid.y(work.tile) + i);
    count.add(edges_of_row(pending.kernels, &pending.state.index[first], &pending.index[first], work.mask.rows[i],
                           grid.tile_width(work.tile)));
  }
  return count;
}

// A tile's importance is estimated from every so manieth row: from all of them where few pixels have changed, of which
// a single one may be what matters.
int row_step(const TileWork& work, Order order) noexcept {
  if (order != Order::gain) return 1;
  const int changed = work.mask.count();
  return changed > kTileWidth * kTileHeight / 4 ? 8 : changed > kTileWidth / 4 ? 4 : 1;
}

}  // namespace

EdgeCount count_edges(const std::vector<TileWork>& tiles, const Pending& pending) {
  const TileGrid grid = grid_of(pending.frame.window());
  std::vector<EdgeCount> counts(tiles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) counts[t] = edges_of_tile(grid, tiles[t], pending);
  });
  EdgeCount sum;
  for (const EdgeCount& count : counts) sum.add(count);
  return sum;
}

SliceQueue::SliceQueue(std::vector<TileWork> tiles, const Pending& pending, const ImportanceOptions& options,
                       const WaitingTimes& waiting, const EdgeCount& edges)
    : tiles_(std::move(tiles)), pending_(pending), rows_done_(tiles_.size()), left_(tiles_.size()), edges_left_(edges) {
  const TileGrid grid = grid_of(pending.frame.window());
  const Priorities priorities(pending, options);
  std::vector<double> importance(tiles_.size());
  std::vector<int> waited(tiles_.size());
  tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
    const TileWork& work = tiles_[t];
    const int step = row_step(work, options.order), width = grid.tile_width(work.tile);
    double sum = 0, largest = 0;
    std::int64_t written = 0;
    for (int i = 0; i < kTileHeight; ++i) {
      if (work.mask.rows[i] == 0) continue;
      const int x = grid.x(work.tile), y = grid.y(work.tile) + i;
      if (waiting.any()) {
        std::uint16_t waits[kTileWidth];
        waiting.of_row(position(grid, x, y), width, waits);
        for_each_pixel(work.mask.rows[i], [&](int p) { waited[t] = std::max<int>(waited[t], waits[p]); });
      }
      if (i % step != 0) continue;
      written += step * row_edges(work, i).written;
      float of_row[kTileWidth];
      priorities.row(x, y, width, of_row);
      for_each_pixel(work.mask.rows[i], [&](int p) {
        sum += step * static_cast<double>(of_row[p]);
        largest = std::max(largest, static_cast<double>(of_row[p]));
      });
    }
    importance[t] =
        options.order == Order::gain ? sum / static_cast<double>(written + reach_work(work, kTileHeight)) : largest;
  });
  for (const TileWork& work : tiles_) work_left_ += reach_work(work, kTileHeight);
  work_left_ += edges.written;
  const std::uint32_t round = scrambled(pending.round);
  const auto tie = [&](std::size_t t) { return scrambled(static_cast<std::uint32_t>(tiles_[t].tile) ^ round); };
  const auto more_important = [&](std::size_t a, std::size_t b) {
    return importance[a] != importance[b] ? importance[a] > importance[b] : tie(a) > tie(b);
  };
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    by_importance_.push_back(t);
    if (waited[t] > 0) by_waiting_.push_back(t);
  }
  std::sort(by_importance_.begin(), by_importance_.end(), more_important);
  std::sort(by_waiting_.begin(), by_waiting_.end(), [&](std::size_t a, std::size_t b) {
    return waited[a] != waited[b] ? waited[a] > waited[b] : more_important(a, b);
  });
}

EdgeCount SliceQueue::row_edges(const TileWork& work, int row) const noexcept {
  const TileGrid grid = grid_of(pending_.frame.window());
  const std::size_t first = position(grid, grid.x(work.tile), grid.y(work.tile) + row);
  return edges_of_row(pending_.kernels, &pending_.state.index[first], &pending_.index[first], work.mask.rows[row],
                      grid.tile_width(work.tile));
}

// Of so many rows of a tile. Sources of neighbouring tiles reach the same pixels: an upper bound.
std::int64_t SliceQueue::reach_work(const TileWork& work, int rows) const noexcept {
  const Kernel& largest = pending_.kernels.kernel(work.max_index);
  return kReachedPixel * (kTileWidth + 2 * largest.radius_x) * (rows + 2 * largest.radius_y);
}

SliceQueue::Slice SliceQueue::next(std::int64_t most_edges, std::int64_t most_work) {
  Slice slice;
  const auto skip_done = [&](const std::vector<std::size_t>& order, std::size_t& at) {
    while (at < order.size() && rows_done_[order[at]] == kTileHeight) ++at;
    return at < order.size();
  };
  serve_waiting_ = !serve_waiting_;
  while (left_ > 0) {
    const bool waiting = serve_waiting_ && skip_done(by_waiting_, next_waiting_);
    if (!waiting) skip_done(by_importance_, next_important_);
    const std::size_t t = waiting ? by_waiting_[next_waiting_] : by_importance_[next_important_];
    const TileWork& work = tiles_[t];
    TileWork part{work.tile, work.max_index, {}};
    int rows = 0;
    for (; rows_done_[t] < kTileHeight; ++rows_done_[t]) {
      const int row = rows_done_[t];
      if (work.mask.rows[row] == 0) continue;
      const EdgeCount edges = row_edges(work, row);
      const bool first = slice.tiles.empty() && !part.mask.any();
      const std::int64_t with_row = slice.work + edges.written + reach_work(work, rows + 1);
      if (!first && (slice.edges.written + edges.written > most_edges || with_row > most_work)) break;
      part.mask.rows[row] = work.mask.rows[row];
      ++rows;
      slice.edges.add(edges);
      slice.work += edges.written;
    }
    if (part.mask.any()) {
      slice.tiles.push_back(part);
      slice.work += reach_work(work, rows);
    }
    if (rows_done_[t] < kTileHeight) break;
    --left_;
  }
  edges_left_.subtract(slice.edges);
  work_left_ -= std::min(work_left_, slice.work);  // the reach of a tile in parts is more than that of the whole
  return slice;
}

}  // namespace pullfocus
