// [threads]: what more threads give.
#include <fmt/format.h>

#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"

namespace pullfocus::cli::bench {

namespace {

struct Speed {
  Spread linear, change;  // times of one thread / of several
};

Speed measure(int width, int height, float radius, int threads, int runs) {
  const Frame frame = planes_and_floor(width, height, 2 * radius);
  Frame changed = frame;
  darken(changed, 0.02, Pattern::patch);
  FilterOptions options;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  std::unique_ptr<Filter> linear[2], incremental[2];
  for (int i = 0; i < 2; ++i) {
    options.threads = i == 0 ? 1 : threads;
    linear[i] = make_linear_filter(frame.window(), options, kernels);
    incremental[i] = make_incremental_filter(frame.window(), options, kernels);
    incremental[i]->filter(frame, kDepthIsCoc);
  }
  // As in a sequence, the frame before kept the same threads busy.
  const auto full = [&](int i) {
    linear[i]->filter(frame, kDepthIsCoc);
    return linear[i]->filter(frame, kDepthIsCoc).filter_ms;
  };
  const auto there_and_back = [&](int i) {
    return incremental[i]->filter(changed, kDepthIsCoc).filter_ms +
           incremental[i]->filter(frame, kDepthIsCoc).filter_ms;
  };
  const auto change = [&](int i) {
    there_and_back(i);
    return there_and_back(i);
  };
  const std::vector<Times> times = in_turn(
      runs, {[&] { return full(0); }, [&] { return full(1); }, [&] { return change(0); }, [&] { return change(1); }});
  return {ratio(times[0], times[1]), ratio(times[2], times[3])};
}

void print(const Settings& settings, Report& report) {
  const std::vector<float> radii = settings.quick ? std::vector{10.f} : std::vector{10.f, 20.f, 40.f};
  std::vector<std::string> columns{"threads"};
  for (const float r : radii) columns.push_back(fmt::format("linear frame, R = {:g}", r));
  for (const float r : radii) columns.push_back(fmt::format("2 % changed, R = {:g}", r));
  report.columns(columns);
  for (int threads = 1; threads <= settings.threads_or(settings.quick ? 2 : settings.processors); ++threads) {
    std::vector<std::string> linear, change;
    for (const float radius : radii) {
      const Speed speed =
          measure(settings.quick ? 320 : 1920, settings.quick ? 180 : 1080, radius, threads, settings.runs_or(7));
      linear.push_back(text(speed.linear, 2));
      change.push_back(text(speed.change, 2));
    }
    std::vector<std::string> cells{fmt::format("{}", threads)};
    cells.insert(cells.end(), linear.begin(), linear.end());
    cells.insert(cells.end(), change.begin(), change.end());
    report.row(cells);
  }
  report.end();
}

}  // namespace

const Table kThreadsTable{
    "threads", "Threads",
    "How many times faster than on one thread a linear frame is, and one in which a patch of 2 % of the pixels "
    "changes its colour: 1920x1080, the scene of `naive`, default settings, each after an untimed frame with as many "
    "threads; median (range).",
    "1 to one a processor", print};

}  // namespace pullfocus::cli::bench
