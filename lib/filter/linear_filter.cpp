#include "filter/linear_filter.h"

#include "importance/select.h"
#include "resolve/held_out.h"
#include "resolve/resolve.h"

namespace pullfocus {

LinearFilter::LinearFilter(const Window& state_window, const FilterOptions& options,
                           std::shared_ptr<const KernelTable> kernels)
    : core_(state_window, options, std::move(kernels)) {}

const Stats& LinearFilter::filter(const Frame& frame, const CocFunction& coc, const StopRequest&) {
  core_.check(frame);
  const Stopwatch whole;
  stats_ = {};
  const SampleType type = frame.colour.type(), result_type = core_.options.output_type.value_or(type);
  if (state_.colour.window() != core_.window || state_.colour.type() != type) state_.reset(core_.window, type);
  if (result_.window() != core_.window || result_.type() != result_type) result_.reset(core_.window, result_type);

  core_.arena.execute([&] {
    const Stopwatch detect;
    const Committed all = commit_all(frame, coc, *core_.kernels, core_.sanitiser, state_, tiles_);
    if (core_.occlusion) core_.occlusion->take(frame, coc.kind, state_, tiles_);
    FilterCore::report(all.findings, stats_);
    result_window_ = core_.reached(all.findings);
    stats_.edges = all.edges;
    stats_.detect_ms = detect.ms();

    const Stopwatch scatter;
    const int lanes = all.opaque ? kOpaqueLanes : kAlphaLanes;
    Sources sources{&state_};
    sources.occlusion = core_.hidden();
    if (core_.backdrop) core_.backdrop->begin_anew();
    core_.scatter.run(by_layer(tiles_, core_.layers, state_, nullptr), sources, lanes, core_.threads,
                      [&](int y, std::span<const LayerRow> rows) {
                        resolve_rows(rows, lanes, y, state_.colour, result_, core_.layers.near(), core_.behind());
                      });
    if (core_.backdrop) core_.backdrop->fill(result_);
    show_held_out(state_, result_);
    stats_.scatter_ms = scatter.ms();
  });
  stats_.mode = ScatterMode::rebuild;
  stats_.slices = 1;
  stats_.changed = stats_.updated = stats_.resolved = static_cast<std::int64_t>(core_.window.pixels());
  stats_.filter_ms = whole.ms();
  return stats_;
}

const Stats& LinearFilter::refine(const StopRequest&) { return stats_ = {}; }

std::unique_ptr<Filter> make_linear_filter(const Window& state_window, const FilterOptions& options,
                                           std::shared_ptr<const KernelTable> kernels) {
  return std::make_unique<LinearFilter>(state_window, options, std::move(kernels));
}

}  // namespace pullfocus
