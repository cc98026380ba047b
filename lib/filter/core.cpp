#include "filter/core.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include "image/error.h"

namespace pullfocus {

namespace {

std::shared_ptr<const KernelTable> table_or_new(std::shared_ptr<const KernelTable> table,
                                                const FilterOptions& options) {
  return table ? std::move(table) : std::make_shared<const KernelTable>(options.kernel);
}

const Window& checked(const Window& window) {
  constexpr int most = 1 << 24;
  if (window.empty() || window.width() > most || window.height() > most || window.pixels() > (1u << 30)) {
    throw Error(ErrorCode::usage, fmt::format("a state window of {} x {} pixels cannot be filtered: it must have 1 "
                                              "to 2^30 pixels",
                                              window.width(), window.height()));
  }
  return window;
}

}  // namespace

FilterCore::FilterCore(const Window& state_window, const FilterOptions& filter_options,
                       std::shared_ptr<const KernelTable> table)
    : window(checked(state_window)),
      options((validate(filter_options), filter_options)),
      threads(options.threads > 0 ? options.threads : tbb::info::default_concurrency()),
      kernels(table_or_new(std::move(table), options)),
      sanitiser(kernels->options().max_radiance),
      arena(threads),
      scatter(*kernels, window.width(), window.height()),
      layers(kernels->coc(), layer_borders(options.visibility)) {
  if (options.visibility.kind == VisibilityOptions::Kind::bitmap) {
    occlusion.emplace(options.visibility, *kernels, window.width(), window.height());
  }
  if (layers.near() > 0 && layers.near() < layers.count()) backdrop.emplace(window.width(), window.height());
}

void FilterCore::check(const Frame& frame) const {
  if (frame.has_mask() && frame.mask.window() != window) {
    throw Error(ErrorCode::usage, "a frame's mask does not cover the same window as its colour: give it that window");
  }
  if (frame.window() == window && frame.depth.window() == window) return;
  const Window& w = frame.window();
  throw Error(
      ErrorCode::usage,
      fmt::format("a frame over x {} .. {}, y {} .. {} cannot follow in a filter made for x {} .. {}, y {} .. {}", w.x0,
                  w.x1 - 1, w.y0, w.y1 - 1, window.x0, window.x1 - 1, window.y0, window.y1 - 1));
}

void FilterCore::set_budget(const Budget& budget) {
  FilterOptions changed = options;
  changed.budget = budget;
  validate(changed);
  options.budget = budget;
}

Window FilterCore::reached(const FrameFindings& findings) const noexcept {
  if (findings.content.empty()) return {window.x0, window.y0, window.x0 + 1, window.y0 + 1};
  const Window& c = findings.content;
  const Window placed{c.x0 + window.x0, c.y0 + window.y0, c.x1 + window.x0, c.y1 + window.y0};
  const int index = findings.content_index;
  return intersect(window, grow(placed, scatter.reach_x(index), scatter.reach_y(index)));
}

void FilterCore::report(const FrameFindings& findings, Stats& stats) noexcept {
  stats.repaired_colour = findings.colour.not_finite;
  stats.repaired_depth = findings.depth;
  stats.clamped_radiance = findings.colour.clamped;
  stats.clamped_coc = findings.coc_clamped;
}

void widen(const ColourImage& half, ColourImage& out) {
  const Window& w = half.window();
  out.reset(w, SampleType::float32);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 4; ++c) out.set(x, y, c, half.get(x, y, c));
    }
  }
}

}  // namespace pullfocus
