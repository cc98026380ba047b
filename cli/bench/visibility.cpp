// [visibility]: what visibility costs.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"
#include "filter/plan.h"

namespace pullfocus::cli::bench {

namespace {

// A slanted floor that is sharp in its middle, and `cards` of constant depth in front of it. CoC up to 2 * radius px.
Frame scene(const Window& window, int cards, unsigned seed) {
  Frame frame;
  frame.colour.reset(window, SampleType::half);
  frame.depth.reset(window, 0);
  frame.has_alpha = false;
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  const int w = window.width(), h = window.height();
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      frame.depth.at(x, y) = 2 / (1.5f - static_cast<float>(y) / static_cast<float>(h));
      for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, uniform(random));
      frame.colour.set(x, y, 3, 1);
    }
  }
  std::reverse(frame.depth.row(0), frame.depth.row(0) + window.pixels());
  for (int i = 0; i < cards; ++i) {
    const float z = 1 + 0.3f * uniform(random);
    const int cx = static_cast<int>(uniform(random) * static_cast<float>(w)),
              cy = static_cast<int>(uniform(random) * static_cast<float>(h));
    const int a = w / 12, b = h / 8;
    for (int y = std::max(cy - b, 0); y < std::min(cy + b, h); ++y) {
      for (int x = std::max(cx - a, 0); x < std::min(cx + a, w); ++x) frame.depth.at(x, y) = z;
    }
  }
  return frame;
}

void measure(const Window& window, int cards, float radius, int bitmap_size, int runs, Report& report) {
  FilterOptions options;
  options.threads = 1;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const Frame frame = scene(window, cards, 1);
  CocFunction coc;
  coc.inverse_focus = 0.5f;
  coc.scale = 4 * radius;  // depths 1 and infinity have radius R
  constexpr std::size_t modes = 3;
  const VisibilityOptions visibilities[modes] = {{VisibilityOptions::Kind::none, {}, 2, 0},
                                                 VisibilityOptions{},
                                                 {VisibilityOptions::Kind::bitmap, {}, bitmap_size, 3}};
  std::unique_ptr<Filter> filters[modes];
  Plan plans[modes];
  for (std::size_t m = 0; m < modes; ++m) {
    options.visibility = visibilities[m];
    filters[m] = make_linear_filter(window, options, kernels);
    plans[m] = make_plan(options, *kernels, frame, coc, nullptr, coc);
  }
  std::vector<std::function<double()>> things;
  for (const auto& filter : filters) {
    things.push_back([&] {
      const std::clock_t start = std::clock();
      filter->filter(frame, coc);
      return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    });
  }
  const std::vector<Times> times = in_turn(runs, things);
  std::vector<std::string> cells{fmt::format("{}", cards),
                                 fmt::format("{:g}", radius),
                                 fmt::format("{}", bitmap_size),
                                 fmt::format("{:.1f} %", 100. * static_cast<double>(plans[2].bitmap_pixels) /
                                                             static_cast<double>(window.pixels())),
                                 fmt::format("{:.2f}", ratio(times[1], times[0]).median),
                                 fmt::format("{:.2f}", ratio(times[2], times[0]).median)};
  for (const Plan& plan : plans) cells.push_back(fmt::format("{:.0f}", plan.state_bytes_per_pixel));
  report.row(cells);
}

void print(const Settings& settings, Report& report) {
  const Window window = settings.quick ? Window{0, 0, 192, 108} : Window{0, 0, 1920, 1080};
  report.columns({"cards", "R", "L", "pixels with bitmaps", "time, layers / none", "bitmaps / none",
                  "bytes a pixel, none", "layers", "bitmaps"});
  for (const int cards : {0, 5, 25}) {
    for (const float radius : {5.f, 10.f, 16.f}) measure(window, cards, radius, 32, settings.runs_or(15), report);
  }
  if (!settings.quick) {
    measure(window, 25, 16, 16, settings.runs_or(9), report);
    measure(window, 25, 30, 64, settings.runs_or(9), report);
  }
  report.end();
}

}  // namespace

const Table kVisibilityTable{
    "visibility",
    "Visibility",
    "Linear frames with layers and with `--visibility bitmap:L`, K = 3 px, against plain ones: cards before a slanted "
    "floor that goes through focus, 1920x1080, half RGB, radii up to R; medians of ratios of processor time, and "
    "bytes of the filter's state as the plan predicts them.",
    "1",
    print,
    true};

}  // namespace pullfocus::cli::bench
