// Ratios of frame times, from interleaved runs: linear against the naive O(R^2) scatter, and unchanged and partly
// changed frames against linear. Prints a Markdown table; judges nothing.
//
//   ratios [--quick] [--threads N]
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>

#include "filter/core.h"
#include "filter/filter.h"
#include "measure.h"
#include "naive_filter.h"

namespace {

using namespace pullfocus;

// Planes, a slanted floor and 6 % of noisy pixels; depth is the signed CoC, up to `largest` px across.
Frame scene(int width, int height, float largest) {
  Frame frame;
  frame.colour.reset({0, 0, width, height}, SampleType::half);
  frame.depth.reset({0, 0, width, height}, 0);
  frame.has_alpha = false;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  const float planes[] = {-1, -0.5f, 0.02f};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int sixth = x * 6 / width;
      float coc = sixth < 3 ? planes[sixth] : static_cast<float>(y) / static_cast<float>(height);
      if (uniform(random) < 0.06f) coc = uniform(random) * 2 - 1;
      frame.depth.at(x, y) = coc * largest;
      for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, uniform(random));
      frame.colour.set(x, y, 3, 1);
    }
  }
  return frame;
}

Frame darker_patch(const Frame& frame, double share) {
  Frame changed = frame;
  const Window& w = frame.window();
  const double side = std::sqrt(share);
  const int width = static_cast<int>(w.width() * side), height = static_cast<int>(w.height() * side);
  const int x0 = (w.width() - width) / 2, y0 = (w.height() - height) / 2;
  for (int y = y0; y < y0 + height; ++y) {
    for (int x = x0; x < x0 + width; ++x) {
      changed.colour.set(x, y, 0, frame.colour.get(x, y, 0) * 0.5f);
    }
  }
  return changed;
}

using test::median;

// Times a and b in turn and returns the median of a / b.
double ratio(int runs, const std::function<void()>& a, const std::function<void()>& b) {
  std::vector<double> ratios;
  for (int i = 0; i <= runs; ++i) {
    const Stopwatch first;
    a();
    const double a_ms = first.ms();
    const Stopwatch second;
    b();
    const double b_ms = second.ms();
    if (i > 0) ratios.push_back(a_ms / b_ms);  // the first round warms up
  }
  return median(ratios);
}

void measure(int width, int height, float radius, int threads, int runs) {
  const Window window{0, 0, width, height};
  FilterOptions options;
  options.visibility.kind = VisibilityOptions::Kind::none;
  options.threads = threads;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto linear = make_linear_filter(window, options, kernels);
  const auto incremental = make_incremental_filter(window, options, kernels);
  test::NaiveFilter<double> naive(*kernels);
  test::NaiveFilter<float> naive_simd(*kernels);
  tbb::task_arena arena(threads);
  const Frame a = scene(width, height, 2 * radius), b = darker_patch(a, 0.02);
  CocFunction coc;
  coc.kind = DepthKind::coc;

  const auto run_linear = [&] { linear->filter(a, coc); };
  const auto run_naive = [&](auto& filter) { arena.execute([&] { filter.filter(a, coc); }); };
  incremental->filter(a, coc);
  bool patched = false;
  const auto run_patch = [&] {
    patched = !patched;
    incremental->filter(patched ? b : a, coc);
  };
  const double against_naive = ratio(
      runs, [&] { run_naive(naive); }, run_linear);
  const double against_simd = ratio(
      runs, [&] { run_naive(naive_simd); }, run_linear);
  const double patch = ratio(2 * runs, run_patch, run_linear);
  const Frame all = darker_patch(a, 1);
  const double everything = ratio(
      2 * runs,
      [&] {
        patched = !patched;
        incremental->filter(patched ? all : a, coc);
      },
      run_linear);
  incremental->filter(a, coc);
  const double unchanged = ratio(2 * runs, run_linear, [&] { incremental->filter(a, coc); });
  fmt::print("| {:g} | {} | {:.1f} | {:.1f} | {:.1f} | {:.3f} | {:.2f} |\n", radius, threads, against_naive,
             against_simd, unchanged, patch, everything);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  std::vector<int> threads{1};
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) quick = true;
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) threads = {std::atoi(argv[++i])};
  }
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads[0]));
  const int width = quick ? 320 : 1920, height = quick ? 180 : 1080;
  fmt::print("{}x{}, kernels up to radius R, half RGB, medians of ratios of interleaved runs\n\n", width, height);
  fmt::print(
      "| R | threads | naive double / linear | naive float SIMD / linear | linear / unchanged frame | 2 % changed / "
      "linear | everything changed / linear |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const float radius : {5.f, 10.f, 20.f, 40.f}) {
    if (quick && radius > 10) break;
    for (const int n : threads) measure(width, height, radius, n, quick ? 1 : 5);
  }
  return 0;
}
