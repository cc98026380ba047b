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
  options.visibility.kind = VisibilityOptions::Kind::none;
  options.threads = threads;
  options.kernel.max_coc_px = 2 * static_cast<double>(radius);
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto linear = make_linear_filter(frame.window(), options, kernels);
  NaiveFilter<float> interleaved(*kernels, Layout::interleaved), planar(*kernels, Layout::planar);
  NaiveFilter<double> twin(*kernels, Layout::interleaved);
  tbb::task_arena arena(threads);
  const auto naive = [&](auto& filter) {
    return wall_ms([&] { arena.execute([&] { filter.filter(frame, kDepthIsCoc); }); });
  };
  const std::vector<Times> times =
      in_turn(runs, {[&] { return wall_ms([&] { linear->filter(frame, kDepthIsCoc); }); },
                     [&] { return naive(interleaved); }, [&] { return naive(planar); }, [&] { return naive(twin); }});
  const std::size_t pixels = frame.window().pixels();
  const bool is_planar = median(times[2]) < median(times[1]);
  const Times& best = times[is_planar ? 2 : 1];
  report.row({fmt::format("{:g}", radius), text(ns_a_pixel(times[0], pixels)), text(ns_a_pixel(best, pixels)),
              text(ratio(best, times[0]), 2), is_planar ? "planar" : "interleaved", text(ns_a_pixel(times[3], pixels)),
              text(ratio(times[3], times[0]), 2)});
}

void print(const Settings& settings, Report& report) {
  report.columns({"R", "linear, ns a pixel", "naive float, ns a pixel", "naive float / linear", "best layout",
                  "naive double, ns a pixel", "naive double / linear"});
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
    "has it with fused multiply-add: in float, the faster of two layouts of its sums, and in double, as accurate as "
    "the "
    "filter.",
    "1", print};

}  // namespace pullfocus::cli::bench
