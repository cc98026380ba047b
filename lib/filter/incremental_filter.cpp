#include "filter/incremental_filter.h"

#include <algorithm>

#include "filter/assess.h"
#include "filter/call.h"

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

std::unique_ptr<Filter> make_incremental_filter(const Window& state_window, const FilterOptions& options,
                                                std::shared_ptr<const KernelTable> kernels) {
  return std::make_unique<IncrementalFilter>(state_window, options, std::move(kernels));
}

}  // namespace pullfocus
