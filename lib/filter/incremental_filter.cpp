#include "filter/incremental_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "resolve/resolve.h"

namespace pullfocus {

namespace {

std::int64_t count_pixels(const std::vector<TileWork>& tiles) noexcept {
  return std::accumulate(tiles.begin(), tiles.end(), std::int64_t{0},
                         [](std::int64_t sum, const TileWork& work) { return sum + work.mask.count(); });
}

}  // namespace

IncrementalFilter::IncrementalFilter(const Window& state_window, const FilterOptions& options,
                                     std::shared_ptr<const KernelTable> kernels)
    : core_(state_window, options, std::move(kernels)) {
  reset();
}

void IncrementalFilter::reset() {
  state_.reset(core_.window, SampleType::half);
  pending_.assign(core_.window.pixels(), 0);
  lanes_ = kOpaqueLanes;
  sums_.assign(core_.window.pixels() * static_cast<std::size_t>(lanes_), 0);
  uncommitted_ = static_cast<std::int64_t>(core_.window.pixels());
  edges_ = 0;
  waiting_.clear();
  dirty_.reset(core_.window.width(), core_.window.height());
  result_window_ = {};
  result_ = {};
}

// The state is kept in half as long as every frame was half; the first float frame widens it for good.
const Frame& IncrementalFilter::in_state_type(const Frame& frame) {
  if (frame.colour.type() == state_.colour.type()) return frame;
  if (frame.colour.type() == SampleType::float32) {
    ColourImage wide;
    widen(state_.colour, wide);
    state_.colour = std::move(wide);
    return frame;
  }
  widen(frame.colour, widened_.colour);
  widened_.depth = frame.depth;
  widened_.has_alpha = frame.has_alpha;
  return widened_;
}

void IncrementalFilter::prepare_result(SampleType type) {
  if (result_.window() == core_.window && result_.type() == type) return;
  result_.reset(core_.window, type);
  for (int y = 0; y < core_.window.height(); ++y) dirty_.mark(y, 0, core_.window.width());
}

// Until now every alpha was exactly 1, so the alpha sums are the weights.
void IncrementalFilter::widen_lanes() {
  const std::size_t pixels = core_.window.pixels();
  std::vector<Accumulator> wide(pixels * kAlphaLanes);
  for (std::size_t p = 0; p < pixels; ++p) {
    const Accumulator* in = &sums_[p * kOpaqueLanes];
    Accumulator* out = &wide[p * kAlphaLanes];
    std::copy_n(in, kOpaqueLanes, out);
    out[kAlphaLane] = in[kWeightLane];
  }
  sums_ = std::move(wide);
  lanes_ = kAlphaLanes;
}

const Stats& IncrementalFilter::filter(const Frame& frame_as_given, const CocFunction& coc, const StopRequest& stop) {
  core_.check(frame_as_given);
  const Stopwatch whole;
  stats_ = {};
  core_.arena.execute([&] {
    const Frame& frame = in_state_type(frame_as_given);
    prepare_result(core_.options.output_type.value_or(frame_as_given.colour.type()));

    const Stopwatch detect;
    const Pending pending{frame, state_, pending_, *core_.kernels, core_.sanitiser};
    const Changes changes =
        find_changes(frame, coc, core_.kernels->coc(), core_.sanitiser, state_, core_.options.thresholds, pending_);
    if (!changes.opaque && lanes_ == kOpaqueLanes) widen_lanes();
    const std::vector<TileWork> selected = select(changes, pending);
    FilterCore::report(changes.findings, stats_);
    stats_.changed = changes.pixels;
    stats_.detect_ms = detect.ms();

    const Stopwatch scatter;
    const bool was_incomplete = uncommitted_ > 0;
    const std::vector<TileWork> done = take_over(selected, pending, stop);
    stats_.scatter_ms = scatter.ms();

    const Stopwatch resolve;
    stats_.left_over = stats_.changed - stats_.updated;
    const TileGrid grid{core_.window.width(), core_.window.height()};
    waiting_.update(grid, stats_.left_over > 0 ? without(changes.tiles, done) : std::vector<TileWork>{});
    const Window reached = core_.reached(changes.findings);
    // What was left over or exempt may show what this frame no longer has.
    const bool behind = stats_.left_over > 0 || core_.options.thresholds.any();
    result_window_ = behind ? unite(result_window_, reached) : reached;
    if (was_incomplete) count_uncommitted();
    resolve_dirty();
    if (uncommitted_ > 0) show_uncommitted(frame);
    stats_.resolve_ms = resolve.ms();
  });
  stats_.filter_ms = whole.ms();
  return stats_;
}

std::vector<TileWork> IncrementalFilter::select(const Changes& changes, const Pending& pending) const {
  const bool first = uncommitted_ == static_cast<std::int64_t>(core_.window.pixels());
  const Budget& budget = core_.options.budget;
  const Allowance allowance{first ? changes.pixels : budget.pixels(changes.pixels), budget.longest_wait()};
  return select_pixels(changes, pending, core_.options.importance, waiting_, allowance);
}

std::vector<TileWork> IncrementalFilter::take_over(const std::vector<TileWork>& selected, const Pending& pending,
                                                   const StopRequest& stop) {
  if (!stop) {
    const EdgeCount edges = count_edges(selected, pending);
    if (rebuild_is_cheaper(edges, count_pixels(selected))) {
      rebuild(selected, edges, pending);
    } else {
      update(selected, edges, pending);
    }
    return selected;
  }
  std::vector<TileWork> done;
  for (const auto& slice : cut_slices(selected, pending, core_.options.importance, core_.options.slice_edges)) {
    if (stop()) break;
    update(slice, count_edges(slice, pending), pending);
    done.insert(done.end(), slice.begin(), slice.end());
  }
  return merged(std::move(done));
}

// Edges decide. Changed pixels lie scattered and convert two colours, hence a quarter more an edge than a
// rebuild.
bool IncrementalFilter::rebuild_is_cheaper(const EdgeCount& edges, std::int64_t updated) const noexcept {
  const std::int64_t edges_after = edges_ + edges.committed;
  const auto pixels = static_cast<std::int64_t>(core_.window.pixels());
  return updated > 0 && 5 * edges.written + 32 * updated > 4 * edges_after + 32 * pixels;
}

void IncrementalFilter::update(const std::vector<TileWork>& selected, const EdgeCount& edges, const Pending& pending) {
  if (selected.empty()) return;
  const auto lanes = static_cast<std::size_t>(lanes_), width = static_cast<std::size_t>(core_.window.width());
  core_.scatter.run(selected, {&state_, &pending.frame, pending_.data(), &core_.sanitiser}, lanes_, core_.threads,
                    [&](int y, int x0, int x1, const Accumulator* values) {
                      Accumulator* sums = &sums_[(static_cast<std::size_t>(y) * width + x0) * lanes];
                      const std::size_t n = static_cast<std::size_t>(x1 - x0) * lanes;
                      for (std::size_t i = 0; i < n; ++i) sums[i] += values[i];
                      dirty_.mark(y, x0, x1);
                    });
  commit(pending.frame, core_.sanitiser, pending_, selected, state_);
  edges_ += edges.committed;
  stats_.edges += edges.written;
  stats_.updated += count_pixels(selected);
  stats_.mode = ScatterMode::incremental;
}

void IncrementalFilter::rebuild(const std::vector<TileWork>& selected, const EdgeCount& edges, const Pending& pending) {
  edges_ += edges.committed;
  commit(pending.frame, core_.sanitiser, pending_, selected, state_);
  std::fill(sums_.begin(), sums_.end(), Accumulator{0});
  const auto lanes = static_cast<std::size_t>(lanes_), width = static_cast<std::size_t>(core_.window.width());
  core_.scatter.run(whole_state(state_), {&state_}, lanes_, core_.threads,
                    [&](int y, int x0, int x1, const Accumulator* values) {
                      const std::size_t n = static_cast<std::size_t>(x1 - x0) * lanes;
                      std::copy_n(values, n, &sums_[(static_cast<std::size_t>(y) * width + x0) * lanes]);
                      resolve_span(values, lanes_, x0, x1, y, state_.colour, result_);
                    });
  dirty_.reset(core_.window.width(), core_.window.height());
  stats_.edges += edges_;
  stats_.updated += count_pixels(selected);
  stats_.resolved += static_cast<std::int64_t>(core_.window.pixels());
  stats_.mode = ScatterMode::rebuild;
}

void IncrementalFilter::count_uncommitted() {
  uncommitted_ = std::count(state_.index.begin(), state_.index.end(), kNeverCommitted);
  // Such pixels showed the input: those that have been committed since must be resolved wherever they lie.
  if (stats_.mode == ScatterMode::rebuild && uncommitted_ == 0) return;
  for (int y = 0; y < core_.window.height(); ++y) dirty_.mark(y, 0, core_.window.width());
}

// A pixel never committed shows the frame itself, sanitised.
void IncrementalFilter::show_uncommitted(const Frame& frame) {
  const Window& w = core_.window;
  dispatch(frame.colour.type(), [&]<SampleType type>() {
    tbb::parallel_for(w.y0, w.y1, [&](int y) {
      const std::int16_t* index =
          &state_.index[static_cast<std::size_t>(y - w.y0) * static_cast<std::size_t>(w.width())];
      for (int x = w.x0; x < w.x1; ++x) {
        if (index[x - w.x0] != kNeverCommitted) continue;
        const Pixel<type> pixel = core_.sanitiser(load_pixel<type>(frame.colour.pixel(x, y)));
        for (int c = 0; c < 4; ++c) {
          const float value = sample_value(pixel.rgba[c]);
          result_.set(x, y, c, result_.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
        }
      }
    });
  });
}

void IncrementalFilter::resolve_dirty() {
  std::vector<std::int64_t> resolved(static_cast<std::size_t>(core_.window.height()));
  const auto lanes = static_cast<std::size_t>(lanes_), width = static_cast<std::size_t>(core_.window.width());
  tbb::parallel_for(0, core_.window.height(), [&](int y) {
    dirty_.drain_row(y, [&](int x0, int x1) {
      const Accumulator* values = &sums_[(static_cast<std::size_t>(y) * width + x0) * lanes];
      resolve_span(values, lanes_, x0, x1, y, state_.colour, result_);
      resolved[static_cast<std::size_t>(y)] += x1 - x0;
    });
  });
  stats_.resolved += std::accumulate(resolved.begin(), resolved.end(), std::int64_t{0});
}

std::unique_ptr<Filter> make_incremental_filter(const Window& state_window, const FilterOptions& options,
                                                std::shared_ptr<const KernelTable> kernels) {
  return std::make_unique<IncrementalFilter>(state_window, options, std::move(kernels));
}

}  // namespace pullfocus
