// [threads]: what more threads give.
#include <fmt/format.h>

#include <barrier>
#include <thread>

#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/core.h"
#include "filter/filter.h"

namespace pullfocus::cli::bench {

namespace {

// One linear filter of one thread for each of several processors, with frames and states of their own.
class SideBySide {
 public:
  SideBySide(const Frame& frame, const FilterOptions& options, const std::shared_ptr<const KernelTable>& kernels,
             int count)
      : frames_(static_cast<std::size_t>(count), frame) {
    for (const Frame& own : frames_) filters_.push_back(make_linear_filter(own.window(), options, kernels));
  }

  // Milliseconds until the last of them has filtered a frame, all from the same moment, after an untimed one.
  double filter() {
    Stopwatch watch;
    double ms = 0;
    std::barrier together(static_cast<std::ptrdiff_t>(filters_.size()), [&]() noexcept {
      ms = watch.ms();
      watch = {};
    });
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < filters_.size(); ++i) {
      threads.emplace_back([&, i] {
        for (int frame = 0; frame < 2; ++frame) {
          filters_[i]->filter(frames_[i], kDepthIsCoc);
          together.arrive_and_wait();
        }
      });
    }
    threads.clear();
    return ms;
  }

 private:
  std::vector<Frame> frames_;
  std::vector<std::unique_ptr<Filter>> filters_;
};

struct Speed {
  Spread linear, change;  // times of one thread / of several
  Spread side_by_side;    // frames of as many filters in the time of one frame alone
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
  options.threads = 1;
  SideBySide side_by_side(frame, options, kernels, threads);
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
  const auto share = [&] { return side_by_side.filter() / threads; };  // time a frame
  const std::vector<Times> times = in_turn(runs, {[&] { return full(0); }, [&] { return full(1); }, share,
                                                  [&] { return change(0); }, [&] { return change(1); }});
  return {ratio(times[0], times[1]), ratio(times[3], times[4]), ratio(times[0], times[2])};
}

void print(const Settings& settings, Report& report) {
  const std::vector<float> radii = settings.quick ? std::vector{10.f} : std::vector{10.f, 20.f, 40.f};
  std::vector<std::string> columns{"threads"};
  for (const float r : radii) columns.push_back(fmt::format("linear frame, R = {:g}", r));
  for (const float r : radii) columns.push_back(fmt::format("side by side, R = {:g}", r));
  for (const float r : radii) columns.push_back(fmt::format("2 % changed, R = {:g}", r));
  report.columns(columns);
  for (int threads = 1; threads <= settings.threads_or(settings.quick ? 2 : settings.processors); ++threads) {
    std::vector<std::string> linear, side_by_side, change;
    for (const float radius : radii) {
      const Speed speed =
          measure(settings.quick ? 320 : 1920, settings.quick ? 180 : 1080, radius, threads, settings.runs_or(7));
      linear.push_back(text(speed.linear, 2));
      side_by_side.push_back(text(speed.side_by_side, 2));
      change.push_back(text(speed.change, 2));
    }
    std::vector<std::string> cells{fmt::format("{}", threads)};
    for (const auto& of : {linear, side_by_side, change}) cells.insert(cells.end(), of.begin(), of.end());
    report.row(cells);
  }
  report.end();
}

}  // namespace

const Table kThreadsTable{
    "threads", "Threads",
    "How many times faster than on one thread a linear frame is, and one in which a patch of 2 % of the pixels "
    "changes its colour: 1920x1080, the scene of `naive`, default settings, each after an untimed frame with as many "
    "threads; median (range). *Side by side*: what the machine itself gives, as many filters of one thread each, with "
    "frames of their own: how many frames they make, the last one included, in the time of one alone.",
    "1 to one a processor", print};

}  // namespace pullfocus::cli::bench
