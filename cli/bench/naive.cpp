// [naive]: full frames against the naive scatter.
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "bench/naive_filter.h"
#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"

namespace pullfocus::cli::bench {

namespace {

void measure(int width, int height, float radius, int threads, int runs, Report& report) {
  const Frame frame = planes_and_floor(width, height, 2 * radius);
  FilterOptions options;
  options.threads = threads;
  options.kernel.max_coc_px = 2 * static_cast<double>(radius);
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto with_layers = make_linear_filter(frame.window(), options, kernels);
  options.visibility.kind = VisibilityOptions::Kind::none;
  const auto linear = make_linear_filter(frame.window(), options, kernels);
  NaiveFilter<float> by_source(*kernels, Way::by_source), by_row(*kernels, Way::by_row);
  NaiveFilter<double> twin_by_source(*kernels, Way::by_source), twin_by_row(*kernels, Way::by_row);
  tbb::task_arena arena(threads);
  const auto naive = [&](auto& filter) {
    return wall_ms([&] { arena.execute([&] { filter.filter(frame, kDepthIsCoc); }); });
  };
  const std::vector<Times> times = in_turn(
      runs, {[&] { return wall_ms([&] { linear->filter(frame, kDepthIsCoc); }); }, [&] { return naive(by_source); },
             [&] { return naive(by_row); }, [&] { return naive(twin_by_source); }, [&] { return naive(twin_by_row); },
             [&] { return wall_ms([&] { with_layers->filter(frame, kDepthIsCoc); }); }});
  const std::size_t pixels = frame.window().pixels();
  std::vector<std::string> cells{fmt::format("{:g}", radius), text(ns_a_pixel(times[0], pixels))};
  for (const std::size_t first : {std::size_t{1}, std::size_t{3}}) {
    const bool rows = median(times[first + 1]) < median(times[first]);
    const Times& best = times[first + (rows ? 1 : 0)];
    cells.insert(cells.end(),
                 {text(ns_a_pixel(best, pixels)), text(ratio(best, times[0]), 2), rows ? "row" : "source"});
  }
  cells.insert(cells.end(), {text(ns_a_pixel(times[5], pixels)), text(ratio(times[5], times[0]), 2)});
  report.row(cells);
}

void print(const Settings& settings, Report& report) {
  report.columns({"R", "linear, ns a pixel", "naive float, ns a pixel", "naive float / linear", "by",
                  "naive double, ns a pixel", "naive double / linear", "by", "linear with layers, ns a pixel",
                  "layers / none"});
  for (const float radius : {2.f, 5.f, 10.f, 20.f, 40.f, 80.f}) {
    if (settings.quick && radius > 10) break;
    measure(settings.quick ? 320 : 1920, settings.quick ? 180 : 1080, radius, settings.threads_or(1),
            settings.runs_or(radius > 20 ? 3 : 7), report);
  }
  report.end();
}

}  // namespace

const Table kNaiveTable{
    "naive", "Full frames against the naive scatter",
    "A linear frame of 1920x1080 (planes, a slanted floor and 6 % of noisy pixels, radii up to R, half RGB, no "
    "visibility) against the O(R²) scatter of the same kernels from tables of weights, SIMD as wide as the processor "
    "has it with fused multiply-add, in float and in double, which is as accurate as the filter: the faster one of "
    "two ways, source by source or row by row for a few sources at a time; and the same frame with layers, the "
    "default, of which all three are everywhere here; median (range).",
    "1", print};

}  // namespace pullfocus::cli::bench
