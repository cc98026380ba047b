// What visibility costs: linear frames with layers and with bitmaps against plain ones, medians of ratios of processor
// time of interleaved runs, one thread, and memory. Prints a Markdown table; judges nothing.
//
//   visibility [--quick]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <random>

#include "filter/core.h"
#include "filter/filter.h"
#include "filter/plan.h"
#include "measure.h"

namespace {

using namespace pullfocus;

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

using test::median;

void measure(const Window& window, int cards, float radius, int bitmap_size, int runs) {
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
  std::vector<double> ratios[modes];
  for (int i = 0; i <= runs; ++i) {
    double times[modes];
    for (std::size_t m = 0; m < modes; ++m) {
      const std::clock_t start = std::clock();
      filters[m]->filter(frame, coc);
      times[m] = static_cast<double>(std::clock() - start);
      if (i > 0) ratios[m].push_back(times[m] / times[0]);  // the first round warms up
    }
  }
  const auto bytes = [&](std::size_t m) { return plans[m].state_bytes_per_pixel; };
  fmt::print("| {} | {:g} | {} | {:.1f} % | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.0f} |\n", cards, radius, bitmap_size,
             100. * static_cast<double>(plans[2].bitmap_pixels) / static_cast<double>(window.pixels()),
             median(ratios[1]), median(ratios[2]), bytes(0), bytes(1), bytes(2));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const Window window = quick ? Window{0, 0, 320, 180} : Window{0, 0, 1920, 1080};
  fmt::print("{}x{}, half RGB, one thread, radii up to R, K = 3 px\n\n", window.width(), window.height());
  fmt::print(
      "| cards | R | L | pixels with bitmaps | time, layers / none | bitmaps / none | bytes a pixel, none | layers | "
      "bitmaps "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const int cards : {0, 5, 25}) {
    for (const float radius : {5.f, 10.f, 16.f}) measure(window, cards, radius, 32, quick ? 1 : 15);
  }
  if (!quick) measure(window, 25, 16, 16, 9);
  if (!quick) measure(window, 25, 30, 64, 9);
  return 0;
}
