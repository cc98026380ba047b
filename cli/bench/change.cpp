// [change]: frames of which a part changed.
#include <fmt/format.h>

#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"

namespace pullfocus::cli::bench {

namespace {

constexpr double kShares[] = {0.01, 0.02, 0.1, 1};

void measure(int width, int height, float radius, Pattern pattern, int threads, int runs, Report& report) {
  const Frame frame = planes_and_floor(width, height, 2 * radius);
  std::vector<Frame> changed;
  for (const double share : kShares) darken(changed.emplace_back(frame), share, pattern);
  FilterOptions options;
  options.visibility.kind = VisibilityOptions::Kind::none;
  options.threads = threads;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto linear = make_linear_filter(frame.window(), options, kernels);
  std::vector<std::function<double()>> things{[&] { return linear->filter(frame, kDepthIsCoc).filter_ms; }};
  // A filter for each share, as a shot that changes by that much throughout; nothing is a share too.
  const auto new_filter = [&] {
    std::shared_ptr<Filter> filter = make_incremental_filter(frame.window(), options, kernels);
    filter->filter(frame, kDepthIsCoc);
    return [filter](const Frame& next) { return filter->filter(next, kDepthIsCoc).filter_ms; };
  };
  things.push_back([&frame, take = new_filter()] { return take(frame); });
  // There and back: both frames change the same pixels.
  for (const Frame& other : changed) {
    things.push_back([&frame, &other, take = new_filter()] { return (take(other) + take(frame)) / 2; });
  }
  const std::vector<Times> times = in_turn(runs, things);
  std::vector<std::string> cells{fmt::format("{:g}", radius), pattern == Pattern::patch ? "one patch" : "at random",
                                 text(ns_a_pixel(times[0], frame.window().pixels()))};
  for (std::size_t i = 1; i < times.size(); ++i) cells.push_back(text(ratio(times[i], times[0]), 3));
  report.row(cells);
}

void print(const Settings& settings, Report& report) {
  std::vector<std::string> columns{"R", "changed pixels", "linear, ns a pixel", "unchanged / linear"};
  for (const double share : kShares) columns.push_back(fmt::format("{:g} % / linear", 100 * share));
  report.columns(columns);
  for (const float radius : {5.f, 10.f, 20.f, 40.f}) {
    if (settings.quick && radius > 10) break;
    for (const Pattern pattern : {Pattern::patch, Pattern::random}) {
      measure(settings.quick ? 320 : 1920, settings.quick ? 180 : 1080, radius, pattern, settings.threads_or(1),
              settings.runs_or(9), report);
    }
  }
  report.end();
}

}  // namespace

const Table kChangeTable{
    "change", "Frames that change in part",
    "Time of an incremental frame in which that share of the pixels changes its colour, in one patch or at random, in "
    "proportion to a linear frame; 1920x1080, radii up to R, half RGB, no visibility, the scene of `naive`; median "
    "(range).",
    "1", print};

}  // namespace pullfocus::cli::bench
