// What --coc-step trades: a slow focus pull at 1080p, error against (nearly) continuous circles of confusion, and the
// work of an incremental frame. Prints a Markdown table; judges nothing.
//
//   coc_steps [--quick] [--threads N]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "filter/filter.h"
#include "measure.h"
#include "star_lateral.h"

namespace {

using namespace pullfocus;

// Focus from 40 to 48 mm over 100 frames at f/12, nothing else moves.
class Pull {
 public:
  Pull(int width, int height) : scene_{width, height} {
    const sequences::StarLateralRenderer renderer(scene_);
    renderer.render(50, frame_);
  }
  const Frame& frame() const { return frame_; }
  CocFunction coc(int frame) const {
    ThinLens lens = sequences::star_lens(scene_);
    const double t = (frame - 1) / 99.;
    lens.focus_distance = 1 / (1 / 0.040 + (1 / 0.048 - 1 / 0.040) * t);
    lens.f_number = 12;
    return coc_function(lens, {scene_.width, scene_.height, 1}, DepthKind::planar);
  }

 private:
  sequences::StarLateral scene_;
  Frame frame_;
};

FilterOptions options_for(double coc_step, int threads) {
  FilterOptions options;
  options.visibility.kind = VisibilityOptions::Kind::none;
  options.kernel.coc_step = coc_step;
  options.output_type = SampleType::float32;
  options.threads = threads;
  return options;
}

struct Error {
  double sum = 0, largest = 0;
  std::int64_t samples = 0;

  void add(const ColourImage& a, const ColourImage& b) {
    const Window& w = a.window();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double d = static_cast<double>(a.get(x, y, c)) - static_cast<double>(b.get(x, y, c));
          sum += d * d;
          largest = std::max(largest, std::fabs(d));
        }
      }
    }
    samples += 3 * static_cast<std::int64_t>(w.pixels());
  }
  double rmse() const { return std::sqrt(sum / static_cast<double>(samples)); }
};

using test::median;

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  int threads = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) quick = true;
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) threads = std::atoi(argv[++i]);
  }
  const Pull pull(quick ? 192 : 1920, quick ? 108 : 1080);
  const Window window = pull.frame().window();
  const int first = 40, last = quick ? 42 : 60;

  FilterOptions fine = options_for(0, threads);
  fine.kernel.smallest_step = 1. / 8;
  fine.kernel.max_coc_px = 100;
  const auto exact = make_linear_filter(window, fine);
  std::vector<ColourImage> truth;
  for (int frame = first; frame <= last; frame += quick ? 1 : 5) {
    exact->filter(pull.frame(), pull.coc(frame));
    truth.push_back(exact->result());
  }

  fmt::print("{}x{}, {} threads, frames {}-{}, against steps of 1/8 px throughout\n\n", window.width(), window.height(),
             threads, first, last);
  fmt::print(
      "| --coc-step | RMSE | PSNR, peak 1 | largest error | pixels updated a frame | edges / linear | time / linear |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const double step : {0., 1. / 128, 1. / 64, 1. / 32, 1. / 16, 1. / 8}) {
    const FilterOptions options = options_for(step, threads);
    const auto linear = make_linear_filter(window, options);
    const auto incremental = make_incremental_filter(window, options);
    Error error;
    std::vector<double> ratios;
    std::int64_t updated = 0, edges = 0, linear_edges = 0;
    for (int frame = first; frame <= last; ++frame) {
      const CocFunction coc = pull.coc(frame);
      const Stats stats = incremental->filter(pull.frame(), coc);
      if (frame > first) {
        const Stats& full = linear->filter(pull.frame(), coc);
        ratios.push_back(stats.filter_ms / full.filter_ms);
        updated += stats.updated;
        edges += stats.edges;
        linear_edges += full.edges;
      }
      const int nth = frame - first;
      if (quick || nth % 5 == 0)
        error.add(incremental->result(), truth[static_cast<std::size_t>(quick ? nth : nth / 5)]);
    }
    const double all = static_cast<double>(window.pixels()) * (last - first);
    fmt::print("| {} | {:.2e} | {:.1f} dB | {:.4f} | {:.1f} % | {:.3f} | {:.3f} |\n",
               step > 0 ? fmt::format("1/{:g}", 1 / step) : "0", error.rmse(), -20 * std::log10(error.rmse()),
               error.largest, 100 * static_cast<double>(updated) / all,
               static_cast<double>(edges) / static_cast<double>(linear_edges), median(ratios));
    std::fflush(stdout);
  }
  return 0;
}
