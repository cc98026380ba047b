// How the incremental filter takes a selection over: at once, in slices, or by a rebuild.
#include <algorithm>
#include <atomic>
#include <limits>

#include "filter/call.h"
#include "filter/incremental_filter.h"
#include "resolve/held_out.h"
#include "resolve/resolve.h"
#include "scatter/occlusion_flips.h"

namespace pullfocus {

std::vector<TileWork> IncrementalFilter::take_over(Call& call, const std::vector<TileWork>& selected) {
  if (selected.empty()) return {};
  const EdgeCount edges = queue_ ? queue_->edges_left() : count_edges(selected, pending());
  bool cheaper = rebuild_is_cheaper(edges, selected);
  if (call.can_be_stopped()) {
    // A rebuild cannot be stopped: it must be sure to end in time. Slices cost more than an update at once; where there
    // is time for a rebuild, it is made if it takes less.
    const double rebuild_ms =
        pace_.rebuild_ms(edges_ + edges.committed, static_cast<std::int64_t>(core_.window.pixels()));
    const bool faster = cheaper || (queue_ && pace_.scatter_ms(queue_->work_left()) > rebuild_ms);
    if (!faster || !call.timed() || rebuild_ms > call.left_ms()) {
      return take_over_in_slices(call, selected, edges);
    }
    cheaper = true;
  }
  queue_.reset();
  if (cheaper || !sums_kept_) {
    edges_ += edges.committed;
    commit(*frame_, core_.sanitiser, pending_, selected, state_);
    if (uncommitted_ > 0) {  // nothing to mark: a rebuild resolves everything
      uncommitted_ = std::count(state_.index.begin(), state_.index.end(), kNeverCommitted);
    }
    rebuild(selected, cheaper, call);
  } else {
    update(selected, edges, true);
  }
  return selected;
}

void IncrementalFilter::take_committed(const Call& call, const std::vector<TileWork>& selected,
                                       const EdgeCount& edges) {
  if (selected.empty()) return;
  const bool cheaper = rebuild_is_cheaper(edges, selected);
  edges_ += edges.committed;
  rebuild(selected, cheaper, call);
}

// Of a time budget, what resolving will take is kept back. The first slice is done in any case, so that calls with too
// short a budget get there too. What is left goes on in the same order in refine().
std::vector<TileWork> IncrementalFilter::take_over_in_slices(Call& call, const std::vector<TileWork>& selected,
                                                             const EdgeCount& edges) {
  // Larger slices scatter faster, small ones stop in time.
  constexpr double least_ms = 1, most_ms = 4;
  const std::int64_t most = call.has_stop_request() ? core_.options.slice_edges
                                                    : std::min(core_.options.slice_edges, std::int64_t{1} << 59) * 8;
  std::vector<TileWork> done;
  if (!queue_) queue_.emplace(selected, pending(), core_.options.importance, waiting_, edges);
  SliceQueue& queue = *queue_;
  std::int64_t dirty = dirty_.pixels(), growth = 0;
  double before = call.timed() ? call.elapsed_ms() : 0;
  while (!queue.empty() && !call.stopped()) {
    std::int64_t work = std::numeric_limits<std::int64_t>::max() / 2;
    if (call.timed()) {
      const double left = core_.options.budget.amount - before - pace_.resolve_ms(dirty + growth);
      if (left <= 0 && stats_.slices > 0) break;
      const double slice_ms = call.has_stop_request() ? most_ms : std::max(left / 3, least_ms);
      work = pace_.work_in(std::min(left, slice_ms));
    }
    const SliceQueue::Slice slice = queue.next(most, work);
    update(slice.tiles, slice.edges, false);
    done.insert(done.end(), slice.tiles.begin(), slice.tiles.end());
    if (!call.timed()) continue;
    const double after = call.elapsed_ms();
    pace_.scattered(slice.work, after - before);
    before = after;
    const std::int64_t now_dirty = dirty_.pixels();
    growth = now_dirty - dirty;
    dirty = now_dirty;
  }
  return merged(std::move(done));
}

// Integers fitted to times of frames done both ways (docs/benchmarks.md, "Update or rebuild"), with 5 for an edge.
// Moved edges are written in one pass over both kernels; a pixel is detected, converted and resolved either way, but
// one by one where changed pixels lie scattered.
//
// A kernel row whose bitmap is looked at costs as much as so many edges, whether anything is hidden there or not. An
// update looks at it before and after the change, at sources that lie scattered, and at others around each pixel whose
// depth has changed: taken as five times the cost in all.
bool IncrementalFilter::rebuild_is_cheaper(const EdgeCount& edges,
                                           const std::vector<TileWork>& selected) const noexcept {
  constexpr std::int64_t kEdge = 5, kMovedEdge = 4, kUpdated = 128, kPixel = 32, kRowEdges = 3;
  const std::int64_t updated = count_pixels(selected);
  const std::int64_t edges_after = edges_ + edges.committed;
  const auto pixels = static_cast<std::int64_t>(core_.window.pixels());
  std::int64_t hidden = 0, hidden_after = 0;
  if (core_.occlusion) {
    hidden = core_.occlusion->need(selected).rows * kRowEdges;
    hidden_after = core_.occlusion->need().rows * kRowEdges;
  }
  const std::int64_t update =
      kEdge * (edges.written - edges.moved + 5 * hidden) + kMovedEdge * edges.moved + kUpdated * updated;
  return updated > 0 && update > kEdge * (edges_after + hidden_after) + kPixel * pixels;
}

void IncrementalFilter::add(const std::vector<LayerWork>& work, const Sources& sources, bool resolve) {
  std::atomic<std::int64_t> resolved{0};
  for (const LayerWork& layer : work) make_room(layer);
  core_.scatter.run(work, sources, lanes(), core_.threads, [&](int y, std::span<const LayerRow> rows) {
    for (const LayerRow& row : rows) {
      for (const ColumnSpan& span : row.spans) {
        sums_.add(row.layer, y, span, row.values + static_cast<std::ptrdiff_t>(span.x0) * lanes());
        dirty_.mark(y, span.x0, span.x1);
      }
    }
    if (resolve) resolved += resolve_dirty_row(y, false);
  });
  stats_.resolved += resolved;
}

// For all that the layer's tiles may reach; folded light stays within that.
void IncrementalFilter::make_room(const LayerWork& work) {
  const TileGrid grid = grid_of(core_.window);
  for (const TileWork& tile : work.tiles) {
    const TileMask::Bounds part = tile.mask.bounds();
    const int x = grid.x(tile.tile), y = grid.y(tile.tile);
    sums_.make_room(work.layer, grow({x + part.x0, y + part.y0, x + part.x1, y + part.y1},
                                     core_.scatter.reach_x(tile.max_index), core_.scatter.reach_y(tile.max_index)));
  }
}

// Held-out pixels show their own colour, whether anything is scattered or not.
void IncrementalFilter::mark_held_out(const std::vector<TileWork>& tiles) {
  if (!state_.may_hold_out) return;
  const TileGrid grid = grid_of(core_.window);
  for (const TileWork& work : tiles) {
    for_each_tile_pixel(grid, work, [&](int, int, int x, int y) {
      if (!is_source(state_.index[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x])) {
        dirty_.mark(y, x, x + 1);
      }
    });
  }
}

void IncrementalFilter::update(const std::vector<TileWork>& selected, const EdgeCount& edges, bool is_last) {
  keep_rule_.updated(!sums_kept_);
  if (!sums_kept_) scatter_state(true, false);
  const Sources change{&state_, frame_, pending_.data(), &core_.sanitiser, core_.hidden()};
  // Nothing else must reach the picture after it.
  const bool resolve = is_last && !core_.occlusion && uncommitted_ == 0 && !state_.may_hold_out;
  add(by_layer(selected, core_.layers, state_, pending_.data()), change, resolve);
  if (core_.occlusion) {
    correct_flips(selected, change, depth_kind_, *core_.kernels, lanes(), [&](int y, int x, const Accumulator* values) {
      sums_.add(0, y, {x, x + 1}, values);
      dirty_.mark(y, x, x + 1);
    });
  }
  no_longer_uncommitted(selected);
  commit(*frame_, core_.sanitiser, pending_, selected, state_);
  if (core_.occlusion) {
    core_.occlusion->take(*frame_, depth_kind_, state_, selected);
    Sources hidden{&state_};
    hidden.occlusion = core_.hidden();
    hidden.is_plain = false;
    add(by_layer(core_.occlusion->needing(selected), core_.layers, state_, nullptr), hidden, false);
  }
  mark_held_out(selected);
  edges_ += edges.committed;
  stats_.edges += edges.written;
  stats_.updated += count_pixels(selected);
  stats_.mode = ScatterMode::incremental;
  ++stats_.slices;
}

// Without sums this is how changes are taken over for which an update would be cheaper, too: no frame then costs more
// than a rebuild that keeps its sums.
void IncrementalFilter::rebuild(const std::vector<TileWork>& selected, bool is_cheaper, const Call& call) {
  if (core_.occlusion) core_.occlusion->take(*frame_, depth_kind_, state_, selected);
  // Pixels never committed will be resolved once more, and no time budget foresees making sums.
  bool keep = uncommitted_ > 0 || call.timed();
  if (is_cheaper) {
    keep |= keep_rule_.keeps();
    keep_rule_.rebuilt(keep);
  } else {
    keep_rule_.updated(true);
    keep = true;
  }
  const double before = call.elapsed_ms();
  scatter_state(keep, true);
  if (round_ > 1) pace_.rebuilt(edges_, call.elapsed_ms() - before);  // memory is touched for the first time before
  dirty_.reset(core_.window.width(), core_.window.height());
  stats_.updated += count_pixels(selected);
  stats_.resolved += static_cast<std::int64_t>(core_.window.pixels());
  stats_.mode = is_cheaper ? ScatterMode::rebuild : ScatterMode::incremental;
  ++stats_.slices;
}

void IncrementalFilter::scatter_state(bool keep, bool resolve) {
  Sources sources{&state_};
  sources.occlusion = core_.hidden();
  const std::vector<LayerWork> work = by_layer(whole_state(state_), core_.layers, state_, nullptr);
  if (resolve && core_.backdrop) core_.backdrop->begin_anew();
  if (keep) {
    sums_.begin_anew();
    for (const LayerWork& layer : work) make_room(layer);
  }
  core_.scatter.run(work, sources, lanes(), core_.threads, [&](int y, std::span<const LayerRow> rows) {
    if (keep) sums_.replace_row(y, rows);
    if (resolve) resolve_rows(rows, lanes(), y, state_.colour, result_, core_.layers.near(), core_.behind());
  });
  if (keep) sums_.end_anew();
  sums_kept_ = keep;
  stats_.edges += edges_;
}

std::vector<Accumulator> IncrementalFilter::accumulators(int layer) const {
  if (sums_kept_) return sums_.plane(layer);
  const int width = core_.window.width(), height = core_.window.height();
  const auto columns = static_cast<std::size_t>(width) * static_cast<std::size_t>(lanes());
  std::vector<Accumulator> plane(columns * static_cast<std::size_t>(height));
  Sources sources{&state_};
  sources.occlusion = core_.hidden();
  Scatter scatter(*core_.kernels, width, height);
  scatter.run(by_layer(whole_state(state_), core_.layers, state_, nullptr), sources, lanes(), core_.threads,
              [&](int y, std::span<const LayerRow> rows) {
                for (const LayerRow& row : rows) {
                  if (row.layer == layer)
                    std::copy_n(row.values, columns, &plane[static_cast<std::size_t>(y) * columns]);
                }
              });
  return plane;
}

}  // namespace pullfocus
