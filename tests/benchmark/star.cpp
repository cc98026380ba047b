// The paper's experiment 1: how many times faster per frame (2 to the last) the incremental filter is than the linear
// one, both run frame by frame in turn. Prints a Markdown table of medians and ranges over whole runs; judges nothing.
//
//   star [--quick] [--threads N]...
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "filter/filter.h"
#include "star_lateral.h"

namespace {

using namespace pullfocus;

struct Times {
  double linear = 0, incremental = 0, detect = 0, scatter = 0, resolve = 0;  // ms, summed over frames
};

Times run(const std::vector<Frame>& frames, const CocFunction& coc, const char* visibility, int threads) {
  FilterOptions options;
  options.threads = threads;
  options.visibility = parse_visibility(visibility);
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto linear = make_linear_filter(frames[0].window(), options, kernels);
  const auto incremental = make_incremental_filter(frames[0].window(), options, kernels);
  Times times;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double linear_ms = linear->filter(frames[i], coc).filter_ms;
    const Stats& stats = incremental->filter(frames[i], coc);
    if (i == 0) continue;
    times.linear += linear_ms;
    times.incremental += stats.filter_ms;
    times.detect += stats.detect_ms;
    times.scatter += stats.scatter_ms;
    times.resolve += stats.resolve_ms;
  }
  return times;
}

void measure(const std::vector<Frame>& frames, const CocFunction& coc, const char* visibility, int threads, int runs) {
  std::vector<double> ratios;
  Times sum;
  for (int i = 0; i < runs; ++i) {
    const Times times = run(frames, coc, visibility, threads);
    ratios.push_back(times.linear / times.incremental);
    sum.linear += times.linear, sum.incremental += times.incremental;
    sum.detect += times.detect, sum.scatter += times.scatter, sum.resolve += times.resolve;
  }
  std::sort(ratios.begin(), ratios.end());
  const double n = runs * static_cast<double>(frames.size() - 1);
  fmt::print("| {} | {} | {:.1f} ({:.1f}-{:.1f}) | {:.2f} | {:.2f} | {:.2f} / {:.2f} / {:.2f} |\n", visibility, threads,
             ratios[ratios.size() / 2], ratios.front(), ratios.back(), sum.linear / n, sum.incremental / n,
             sum.detect / n, sum.scatter / n, sum.resolve / n);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  std::vector<int> threads;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) quick = true;
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) threads.push_back(std::atoi(argv[++i]));
  }
  if (threads.empty()) threads = {1, 2, 4};
  const sequences::StarLateral shot;
  const sequences::StarLateralRenderer renderer(shot);
  std::vector<Frame> frames(quick ? 3 : 100);
  for (std::size_t i = 0; i < frames.size(); ++i) renderer.render(static_cast<int>(i) + 1, frames[i]);
  const Window& window = frames[0].window();
  const auto coc = coc_function(sequences::star_lens(shot), {window.width(), window.height(), 1}, DepthKind::planar);
  fmt::print("{}x{}, {} frames\n\n", window.width(), window.height(), frames.size());
  fmt::print(
      "| visibility | threads | times faster | linear, ms | incremental, ms | detect / scatter / resolve, ms |\n"
      "|---|---|---|---|---|---|\n");
  for (const char* visibility : {"layers", "none"}) {
    for (const int n : threads) measure(frames, coc, visibility, n, quick ? 1 : 9);
  }
  return 0;
}
