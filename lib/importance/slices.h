// The work of a call that can be stopped, cut into slices.
#pragma once

#include <cstdint>
#include <vector>

#include "importance/edge_count.h"
#include "importance/order.h"
#include "importance/waiting.h"

namespace pullfocus {

// What taking `tiles` over writes.
EdgeCount count_edges(const std::vector<TileWork>& tiles, const Pending& pending);

// What integrating and adding the sums of a pixel that a slice reaches costs, in run edges: it waits for memory, not
// for the processor. Measured with slices of 10 to 200 tiles at R = 20.
inline constexpr std::int64_t kReachedPixel = 20;

// Hands out a selection in slices, whole tiles in order of importance: for Order::gain by the sum of priorities per
// work, estimated from some of its rows where much of a tile has changed, for Order::fearing by the most important
// pixel, for Order::random as positions are scrambled. Every second slice serves the tiles that have waited longest, as
// long as any has waited. What `pending` refers to must outlive the queue; its pixels may be committed meanwhile as
// slices are handed out.
class SliceQueue {
 public:
  // `edges` as count_edges() counts them.
  SliceQueue(std::vector<TileWork> tiles, const Pending& pending, const ImportanceOptions& options,
             const WaitingTimes& waiting, const EdgeCount& edges);

  bool empty() const noexcept { return left_ == 0; }

  // The next slice, in no particular order of tiles: at most about `most_edges` edges and `most_work`, but at least one
  // tile row. Not for an empty queue.
  struct Slice {
    std::vector<TileWork> tiles;
    EdgeCount edges;
    std::int64_t work = 0;  // in edges: those written, and what the pixels that they reach cost
  };
  Slice next(std::int64_t most_edges, std::int64_t most_work);

  // Of all that has not been handed out.
  const EdgeCount& edges_left() const noexcept { return edges_left_; }
  std::int64_t work_left() const noexcept { return work_left_; }

 private:
  EdgeCount row_edges(const TileWork& work, int row) const noexcept;
  std::int64_t reach_work(const TileWork& work, int rows) const noexcept;

  const std::vector<TileWork> tiles_;
  const Pending pending_;
  std::vector<std::size_t> by_importance_, by_waiting_;  // positions in tiles_, first comes first
  std::size_t next_important_ = 0, next_waiting_ = 0;
  std::vector<std::uint8_t> rows_done_;  // of every tile; kTileHeight: handed out
  std::size_t left_;
  EdgeCount edges_left_;
  std::int64_t work_left_ = 0;
  bool serve_waiting_ = false;
};

}  // namespace pullfocus
