#include "filter/incremental_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "filter/assess.h"
#include "filter/call.h"
#include "resolve/held_out.h"
#include "resolve/resolve.h"

namespace pullfocus {

IncrementalFilter::IncrementalFilter(const Window& state_window, const FilterOptions& options,
                                     std::shared_ptr<const KernelTable> kernels)
    : core_(state_window, options, std::move(kernels)) {
  reset();
}

void IncrementalFilter::reset() {
  state_.reset(core_.window, SampleType::half);
  if (core_.occlusion) core_.occlusion->reset();
  if (core_.backdrop) core_.backdrop->reset();
  pending_.assign(core_.window.pixels(), 0);
  remembered_.reset(grid_of(core_.window));
  sums_.reset(core_.window.width(), core_.window.height(), core_.layers.count(), kOpaqueLanes);
  sums_kept_ = true;
  keep_rule_ = {};
  uncommitted_ = static_cast<std::int64_t>(core_.window.pixels());
  edges_ = 0;
  waiting_.clear();
  round_ = 0;
  frame_ = nullptr;
  left_.clear();
  queue_.reset();
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
  widened_.mask = frame.mask;
  return widened_;
}

void IncrementalFilter::prepare_result(SampleType type) {
  if (result_.window() == core_.window && result_.type() == type) return;
  result_.reset(core_.window, type);
  for (int y = 0; y < core_.window.height(); ++y) dirty_.mark(y, 0, core_.window.width());
}

Pending IncrementalFilter::pending() const {
  return {*frame_, state_, pending_, *core_.kernels, core_.sanitiser, result_, round_};
}

const Stats& IncrementalFilter::filter(const Frame& frame, const CocFunction& coc, const StopRequest& stop) {
  core_.check(frame);
  const Stopwatch whole;
  Call call(core_.options, stop);
  stats_ = {};
  core_.arena.execute([&] {
    queue_.reset();
    frame_ = &in_state_type(frame);
    depth_kind_ = coc.kind;
    ++round_;
    prepare_result(core_.options.output_type.value_or(frame.colour.type()));

    const Stopwatch detection;
    const bool at_once = takes_all_at_once(call);
    Changes changes = detect(coc, at_once);
    if (!changes.opaque && lanes() == kOpaqueLanes) sums_.widen();
    const std::vector<TileWork> selected = at_once ? changes.tiles : select(changes);
    FilterCore::report(changes.findings, stats_);
    stats_.changed = changes.pixels;
    stats_.detect_ms = detection.ms();
    reached_ = core_.reached(changes.findings);
    finish(call, std::move(changes.tiles), selected, at_once ? &changes.edges : nullptr);
  });
  stats_.filter_ms = whole.ms();
  return stats_;
}

const Stats& IncrementalFilter::refine(const StopRequest& stop) {
  const Stopwatch whole;
  Call call(core_.options, stop);
  stats_ = {};
  if (left_.empty()) return stats_;
  core_.arena.execute([&] {
    ++round_;
    stats_.changed = count_pixels(left_);
    const std::vector<TileWork> selected = left_;
    finish(call, std::move(left_), selected, nullptr);
  });
  stats_.filter_ms = whole.ms();
  return stats_;
}

LeftOver IncrementalFilter::left_over() {
  if (left_.empty()) return {};
  LeftOver result;
  core_.arena.execute([&] { result = assess(left_, pending(), core_.scatter, core_.backdrop ? Backdrop::kReach : 0); });
  return result;
}

void IncrementalFilter::left_over_importance(Plane& out) {
  if (left_.empty()) return out.reset(core_.window, 0);
  core_.arena.execute([&] { importance_of(left_, pending(), core_.options.importance, out); });
}

// Without sums every change means a rebuild, so that what was committed before is not needed once it was compared with.
bool IncrementalFilter::takes_all_at_once(const Call& call) const noexcept {
  const auto pixels = static_cast<std::int64_t>(core_.window.pixels());
  return !sums_kept_ && !call.can_be_stopped() && core_.options.budget.pixels(pixels) == pixels;
}

Changes IncrementalFilter::detect(const CocFunction& coc, bool and_commit) {
  RememberedDepths* remembered = &remembered_;
  if (frame_->has_mask()) {  // indices are not of depths alone
    remembered_.forget();
    remembered = nullptr;
  } else {
    remembered_.begin(coc);
  }
  if (and_commit) {
    return take_changes(*frame_, coc, *core_.kernels, core_.sanitiser, state_, thresholds(), core_.hidden(),
                        remembered);
  }
  return find_changes(*frame_, coc, core_.kernels->coc(), core_.sanitiser, state_, thresholds(), pending_,
                      core_.hidden(), remembered);
}

ChangeThresholds IncrementalFilter::thresholds() const noexcept {
  ChangeThresholds thresholds = core_.options.thresholds;
  if (core_.options.error_bound > 0) thresholds.channel = core_.options.error_bound;
  return thresholds;
}

void IncrementalFilter::finish(Call& call, std::vector<TileWork> changed, const std::vector<TileWork>& selected,
                               const EdgeCount* committed) {
  const Stopwatch scatter;
  std::vector<TileWork> done;
  if (committed == nullptr) {
    done = take_over(call, selected);
  } else {
    take_committed(call, selected, *committed);
  }
  stats_.scatter_ms = scatter.ms();

  const double before_resolve = call.timed() ? call.elapsed_ms() : 0;
  const Stopwatch resolve;
  stats_.left_over = stats_.changed - stats_.updated;
  if (count_pixels(selected) != stats_.changed) queue_.reset();
  left_ = stats_.left_over > 0 ? without(changed, done) : std::vector<TileWork>{};
  waiting_.update({core_.window.width(), core_.window.height()}, left_);
  // What was left over or exempt may show what this frame no longer has.
  const bool behind = stats_.left_over > 0 || thresholds().any();
  result_window_ = behind ? unite(result_window_, reached_) : reached_;
  resolve_dirty();
  if (uncommitted_ > 0) show_uncommitted();
  stats_.resolve_ms = resolve.ms();
  if (call.timed()) {
    if (stats_.mode != ScatterMode::rebuild) pace_.resolved(stats_.resolved, call.elapsed_ms() - before_resolve);
    stats_.overshoot_ms = std::max(-call.left_ms(), 0.);
  }
}

std::vector<TileWork> IncrementalFilter::select(const Changes& changes) const {
  const bool first = uncommitted_ == static_cast<std::int64_t>(core_.window.pixels());
  const Budget& budget = core_.options.budget;
  const Allowance allowance{first ? changes.pixels : budget.pixels(changes.pixels), budget.longest_wait()};
  return select_pixels(changes, pending(), core_.options.importance, waiting_, allowance);
}

// Before they are committed. They showed the input, so they must be resolved even where their kernels do not reach
// them.
void IncrementalFilter::no_longer_uncommitted(const std::vector<TileWork>& tiles) {
  if (uncommitted_ == 0) return;
  const TileGrid grid = grid_of(core_.window);
  for (const TileWork& work : tiles) {
    for_each_tile_pixel(grid, work, [&](int, int, int x, int y) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
      if (state_.index[at] != kNeverCommitted) return;
      --uncommitted_;
      dirty_.mark(y, x, x + 1);
    });
  }
}

// A pixel never committed shows the frame itself, sanitised.
void IncrementalFilter::show_uncommitted() {
  const Window& w = core_.window;
  const auto show_row = [&]<SampleType type, SampleType out_type>(int y) {
    const std::int16_t* index = &state_.index[static_cast<std::size_t>(y - w.y0) * static_cast<std::size_t>(w.width())];
    const auto* in = reinterpret_cast<const Pixel<type>*>(frame_->colour.pixel(w.x0, y));
    auto* out = reinterpret_cast<Pixel<out_type>*>(result_.pixel(w.x0, y));
    for (int i = 0; i < w.width(); ++i) {
      if (index[i] != kNeverCommitted) continue;
      const Pixel<type> pixel = core_.sanitiser(in[i]);
      if constexpr (type == out_type) {
        out[i] = pixel;
        continue;
      }
      for (int c = 0; c < 4; ++c) {
        const float value = sample_value(pixel.rgba[c]);
        if constexpr (out_type == SampleType::float32) {
          std::memcpy(&out[i].rgba[c], &value, sizeof value);
        } else {
          result_.set(w.x0 + i, y, c, std::clamp(value, -65504.f, 65504.f));
        }
      }
    }
  };
  dispatch(frame_->colour.type(), [&]<SampleType type>() {
    dispatch(result_.type(), [&]<SampleType out_type>() {
      tbb::parallel_for(w.y0, w.y1, [&](int y) { show_row.template operator()<type, out_type>(y); });
    });
  });
}

void IncrementalFilter::resolve_dirty() {
  if (dirty_.pixels() > 0) {
    if (!sums_kept_) scatter_state(true, false);  // the result has another type
    resolve_rows_of_sums();
  }
  if (core_.backdrop) core_.backdrop->fill(result_);
  show_held_out(state_, result_);
}

void IncrementalFilter::resolve_rows_of_sums() {
  std::vector<std::int64_t> resolved(static_cast<std::size_t>(core_.window.height()));
  tbb::parallel_for(0, core_.window.height(),
                    [&](int y) { resolved[static_cast<std::size_t>(y)] = resolve_dirty_row(y, true); });
  stats_.resolved += std::accumulate(resolved.begin(), resolved.end(), std::int64_t{0});
}

std::int64_t IncrementalFilter::resolve_dirty_row(int y, bool is_committed) {
  const Accumulator* layers[kMostLayers];
  const auto count = static_cast<std::size_t>(sums_.layers());
  std::int64_t resolved = 0;
  std::vector<ColumnSpan> without_weight;
  dirty_.drain_row(y, [&](int x0, int x1) {
    for (int x = x0; x < x1;) {
      const int end = std::min((x / kTileWidth + 1) * kTileWidth, x1);
      for (std::size_t l = 0; l < count; ++l) layers[l] = sums_.at(static_cast<int>(l), x, y);
      const bool all = resolve_layers({layers, count}, lanes(), x, end, y, state_.colour, result_,
                                      static_cast<std::size_t>(core_.layers.near()), core_.behind());
      if (all || is_committed) {
        resolved += end - x;
      } else {
        without_weight.push_back({x, end});
      }
      x = end;
    }
  });
  for (const ColumnSpan& span : without_weight) dirty_.mark(y, span.x0, span.x1);
  return resolved;
}

std::unique_ptr<Filter> make_incremental_filter(const Window& state_window, const FilterOptions& options,
                                                std::shared_ptr<const KernelTable> kernels) {
  return std::make_unique<IncrementalFilter>(state_window, options, std::move(kernels));
}

}  // namespace pullfocus
