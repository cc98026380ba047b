// What occlusion bitmaps cost: linear frames with them against plain ones, medians of ratios of processor time
// of interleaved runs, one thread. Prints a Markdown table; judges nothing.
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

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void measure(const Window& window, int cards, float radius, int bitmap_size, int runs) {
  FilterOptions options;
  options.threads = 1;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto plain = make_linear_filter(window, options, kernels);
  options.visibility = {VisibilityOptions::Kind::bitmap, {}, bitmap_size, 3};
  const auto with_bitmaps = make_linear_filter(window, options, kernels);
  const Frame frame = scene(window, cards, 1);
  CocFunction coc;
  coc.inverse_focus = 0.5f;
  coc.scale = 4 * radius;  // depths 1 and infinity have radius R
  const Plan plan = make_plan(options, *kernels, frame, coc, nullptr, coc);
  std::vector<double> ratios;
  for (int i = 0; i <= runs; ++i) {
    const std::clock_t a = std::clock();
    plain->filter(frame, coc);
    const std::clock_t b = std::clock();
    with_bitmaps->filter(frame, coc);
    const double first = static_cast<double>(b - a), second = static_cast<double>(std::clock() - b);
    if (i > 0) ratios.push_back(second / first);  // the first round warms up
  }
  fmt::print("| {} | {:g} | {} | {:.1f} % | {:.2f} |\n", cards, radius, bitmap_size,
             100. * static_cast<double>(plan.bitmap_pixels) / static_cast<double>(window.pixels()), median(ratios));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const Window window = quick ? Window{0, 0, 320, 180} : Window{0, 0, 1920, 1080};
  fmt::print("{}x{}, half RGB, one thread, radii up to R, K = 3 px\n\n", window.width(), window.height());
  fmt::print("| cards | R | L | pixels with bitmaps | with / without |\n|---|---|---|---|---|\n");
  for (const int cards : {0, 5, 25}) {
    for (const float radius : {5.f, 10.f, 16.f}) measure(window, cards, radius, 32, quick ? 1 : 15);
  }
  if (!quick) measure(window, 25, 16, 16, 9);
  if (!quick) measure(window, 25, 30, 64, 9);
  return 0;
}
