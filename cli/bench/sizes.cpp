// [sizes]: time and memory a pixel by picture size.
#include <fmt/format.h>
#include <malloc.h>

#include <fstream>

#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"
#include "filter/plan.h"

namespace pullfocus::cli::bench {

namespace {

constexpr float kRadius = 10;

// Bytes that the program has allocated.
double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

// Bytes that the system can give without swapping; 0 if it does not say.
double available() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  for (double kilobytes = 0; file >> name >> kilobytes; std::getline(file, unit)) {
    if (name == "MemAvailable:") return kilobytes * 1024;
  }
  return 0;
}

// Two frames, and both filters with their results.
constexpr double kBytesAPixel = 160;

void measure(int side, int threads, int runs, Report& report) {
  const std::string size = fmt::format("{0}x{0}", side);
  const double pixels = static_cast<double>(side) * side;
  if (available() < pixels * kBytesAPixel) {
    report.row({size, fmt::format("needs {:.1f} GB of memory", pixels * kBytesAPixel / 1e9), "-", "-", "-", "-"});
    return;
  }
  const Frame frame = planes_and_floor(side, side, 2 * kRadius);
  Frame changed = frame;
  darken(changed, 0.02, Pattern::patch);
  FilterOptions options;
  options.threads = threads;
  options.visibility.kind = VisibilityOptions::Kind::none;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const double before = allocated();
  const auto incremental = make_incremental_filter(frame.window(), options, kernels);
  const auto take = [&](const Frame& next) { return incremental->filter(next, kDepthIsCoc).filter_ms; };
  take(frame);
  take(changed);
  const double result_bytes = static_cast<double>(incremental->result().pixel_bytes());
  const double state = (allocated() - before) / pixels - result_bytes;
  const Plan plan = make_plan(options, *kernels, frame, kDepthIsCoc, nullptr, kDepthIsCoc);
  take(frame);
  const auto linear = make_linear_filter(frame.window(), options, kernels);
  const std::vector<Times> times =
      in_turn(runs, {[&] { return linear->filter(frame, kDepthIsCoc).filter_ms; }, [&] { return take(frame); },
                     [&] { return (take(changed) + take(frame)) / 2; }});
  std::vector<std::string> cells{size};
  for (const Times& of : times) cells.push_back(text(ns_a_pixel(of, frame.window().pixels())));
  cells.push_back(fmt::format("{:.1f}", state));
  cells.push_back(fmt::format("{:.1f}", plan.state_bytes_per_pixel));
  report.row(cells);
}

void print(const Settings& settings, Report& report) {
  report.columns({"size", "linear, ns a pixel", "unchanged, ns a pixel", "2 % changed, ns a pixel",
                  "bytes a pixel of state", "bytes a pixel planned"});
  for (int side = 256; side <= (settings.quick ? 512 : 8192); side *= 2) {
    measure(side, settings.threads_or(1), settings.runs_or(side <= 1024 ? 31 : side <= 4096 ? 7 : 3), report);
  }
  report.end();
}

}  // namespace

const Table kSizesTable{
    "sizes", "Sizes",
    "Median time a pixel of a linear frame, of an unchanged one and of one in which a patch of 2 % of the pixels "
    "changes its colour, and bytes of the incremental filter's state as allocated after two frames (its result left "
    "aside, buffers of its threads included) and as the plan predicts them: the scene of `naive`, radii up to 10, "
    "half RGB, without visibility.",
    "1", print};

}  // namespace pullfocus::cli::bench
