#include "hard_measures.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

#include "filter/linear_filter.h"
#include "hard_shots.h"
#include "plain_frames.h"

namespace pullfocus::test {

namespace {

double largest_change(const ColourImage& a, const ColourImage& b) {
  double largest = 0;
  for_each_in(a.window(), [&](int x, int y) {
    largest = std::max(largest, static_cast<double>(std::fabs(a.get(x, y, 0) - b.get(x, y, 0))));
  });
  return largest;
}

float brightest(const ColourImage& image) {
  float most = 0;
  for_each_in(image.window(), [&](int x, int y) { most = std::max(most, image.get(x, y, 0)); });
  return most;
}

template <typename IsWhite>
ColourImage blurred(Filter& filter, const Window& window, double diameter_px, IsWhite&& is_white) {
  Frame frame = flat_frame(window, SampleType::float32, {0, 0, 0, 1}, static_cast<float>(diameter_px));
  for_each_in(window, [&](int x, int y) {
    if (is_white(x, y)) set_colour(frame.colour, x, y, {1, 1, 1, 1});
  });
  filter.filter(frame, coc_as_depth);
  return filter.result();
}

int reach_of(const KernelTable& kernels) {
  int reach = 0;
  for (int i = 0; i < kernels.coc().size(); ++i) reach = std::max(reach, kernels.kernel(i).radius_x);
  return reach;
}

}  // namespace

std::vector<TableStep> table_steps(double up_to_px) {
  const FilterOptions options = options_up_to(up_to_px);
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const int middle = reach_of(*kernels) + 1;
  const Window window{0, 0, 2 * middle + 1, 2 * middle + 1};
  LinearFilter filter(window, options, kernels);
  const auto edge = [&](double d) { return blurred(filter, window, d, [&](int x, int) { return x > middle; }); };
  const auto point = [&](double d) {
    return blurred(filter, window, d, [&](int x, int y) { return x == middle && y == middle; });
  };
  std::vector<TableStep> steps;
  for (int i = 0; i + 1 < kernels->coc().size(); ++i) {
    const double from = kernels->coc().diameter(i), to = kernels->coc().diameter(i + 1);
    const ColourImage before = point(from), after = point(to);
    steps.push_back({from, to, largest_change(edge(from), edge(to)), largest_change(before, after),
                     brightest(after) <= brightest(before)});
  }
  return steps;
}

// The floor lies from 8 to 16 units; a texture of 10 px waves.
Terraces half_terraces() {
  const Window window{0, 0, 200, 24};
  const FilterOptions options = options_up_to(30);
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  LinearFilter exact(window, options, kernels), stepped(window, options, kernels);
  Frame frame = flat_frame(window, SampleType::float32, {0, 0, 0, 1}, 0), halves = frame;
  for_each_in(window, [&](int x, int y) {
    const double wave = std::sin(0.628 * x) * std::sin(0.628 * y);
    const float depth = 8 + 8 * static_cast<float>(y * window.width() + x) / static_cast<float>(window.pixels());
    for (Frame* f : {&frame, &halves}) set_colour(f->colour, x, y, {static_cast<float>(0.5 + 0.5 * wave), 0, 0, 1});
    frame.depth.at(x, y) = depth;
    halves.depth.at(x, y) = imath_half_to_float(imath_float_to_half(depth));
  });
  Terraces is;
  const Footprints footprints(window, kernels);
  constexpr int frames = 40;
  std::int64_t differing = 0;
  for (int f = 0; f < frames; ++f) {
    const CocFunction coc{DepthKind::planar, 400, 1 / (8 + 8 * static_cast<float>(f) / frames)};
    for_each_in(window, [&](int x, int y) {
      const int a = footprints.index_of(coc, frame.depth.at(x, y));
      const int off = std::abs(a - footprints.index_of(coc, halves.depth.at(x, y)));
      differing += off != 0;
      is.largest_index = std::max(is.largest_index, off);
    });
    exact.filter(frame, coc);
    stepped.filter(halves, coc);
    is.picture = std::max(is.picture, largest_change(exact.result(), stepped.result()));
  }
  is.share = static_cast<double>(differing) / static_cast<double>(frames * window.pixels());
  return is;
}

float largest_radiance(double max_coc_px) {
  KernelOptions options;
  options.max_coc_px = max_coc_px;
  options.max_radiance = 1;
  const double limit = 0x1p23 / KernelTable(options).overlap_bound() - 1;
  const auto nearest = static_cast<float>(limit);
  return static_cast<double>(nearest) > limit ? std::nextafter(nearest, 0.f) : nearest;
}

LargestSum largest_sum(double max_coc_px, float radiance) {
  FilterOptions options = options_up_to(max_coc_px);
  options.kernel.max_radiance = radiance > 0 ? radiance : largest_radiance(max_coc_px);
  const float most = options.kernel.max_radiance;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const int middle = reach_of(*kernels);
  const Window window{0, 0, 2 * middle + 1, 2 * middle + 1};
  LargestSum sum{max_coc_px, most, kernels->overlap_bound()};
  Frame frame = flat_frame(window, SampleType::float32, {most, -most, 0, 1}, 0);
  for_each_in(window, [&](int x, int y) {
    std::int64_t largest = -1;
    for (int i = 0; i < kernels->coc().size(); ++i) {
      const std::int64_t weight = kernels->kernel(i).weight(middle - x, middle - y);
      if (weight <= largest) continue;
      largest = weight;
      frame.depth.at(x, y) = static_cast<float>(kernels->coc().diameter(i));
    }
    sum.expected += std::llrint(static_cast<double>(most) * static_cast<double>(largest));
  });
  IncrementalFilter filter(window, options, kernels);
  filter.filter(frame, coc_as_depth);
  const auto pixel = static_cast<std::size_t>(middle) * static_cast<std::size_t>(window.width() + 1);
  const std::vector<Accumulator> plane = filter.accumulators();
  const Accumulator* sums = &plane[pixel * static_cast<std::size_t>(filter.lanes())];
  sum.positive = static_cast<std::int64_t>(sums[0]);
  sum.negative = static_cast<std::int64_t>(sums[1]);
  return sum;
}

OneBucket one_bucket(const Budget& budget, int frames) {
  const Window window{0, 0, 128, 64};
  constexpr int block = 16;
  FilterOptions options = options_up_to(3);
  options.budget = budget;
  options.importance.order = Order::fearing;
  options.importance.w_coc = options.importance.w_rgb = 0;  // nothing is more important than anything else
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  IncrementalFilter filter(window, options, kernels);
  Footprints footprints(window, kernels);
  Frame frame = flat_frame(window, SampleType::float32, {0, 0, 0, 1}, 3);
  filter.filter(frame, coc_as_depth);
  OneBucket result;
  result.fewest = block * block;
  result.per_block = static_cast<double>(budget.pixels(128 * 64)) / (128 * 64 / (block * block));
  std::vector<int> waits(window.pixels());
  for (int f = 1; f <= frames; ++f) {
    for_each_in(window, [&](int x, int y) { frame.colour.set(x, y, 0, uniform(20, f, y * 128 + x, 0, 0, 1)); });
    filter.filter(frame, coc_as_depth);
    std::vector<int> updates(128 / block * (64 / block));
    for_each_in(window, [&](int x, int y) {
      const bool updated = filter.committed().colour.get(x, y, 0) == frame.colour.get(x, y, 0);
      int& wait = waits[static_cast<std::size_t>(y * 128 + x)];
      wait = updated ? 0 : wait + 1;
      result.longest_wait = std::max(result.longest_wait, wait);
      updates[static_cast<std::size_t>(y / block * (128 / block) + x / block)] += updated;
    });
    result.fewest = std::min(result.fewest, *std::ranges::min_element(updates));
    result.most = std::max(result.most, *std::ranges::max_element(updates));
    result.exact &= holds(filter, wide_sums(filter.committed(), footprints));
  }
  return result;
}

}  // namespace pullfocus::test
