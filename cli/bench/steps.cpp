// [steps]: what --coc-step trades.
#include <fmt/format.h>

#include "bench/picture_error.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"
#include "star_lateral.h"

namespace pullfocus::cli::bench {

namespace {

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

class Measurement {
 public:
  explicit Measurement(const Settings& settings)
      : threads_(settings.threads_or(1)),
        every_(settings.quick ? 1 : 5),
        last_(kFirst + (settings.quick ? 2 : 20)),
        pull_(settings.quick ? 192 : 1920, settings.quick ? 108 : 1080) {
    FilterOptions fine = options_for(0, threads_);
    fine.kernel.smallest_step = 1. / 8;
    fine.kernel.max_coc_px = 100;
    const auto exact = make_linear_filter(pull_.frame().window(), fine);
    for (int frame = kFirst; frame <= last_; frame += every_) {
      exact->filter(pull_.frame(), pull_.coc(frame));
      truth_.push_back(exact->result());
    }
  }

  std::vector<std::string> row(double step) const {
    const Window& window = pull_.frame().window();
    const FilterOptions options = options_for(step, threads_);
    const auto linear = make_linear_filter(window, options);
    const auto incremental = make_incremental_filter(window, options);
    PictureError error;
    Times of_incremental, of_linear;
    std::int64_t updated = 0, edges = 0, linear_edges = 0;
    for (int frame = kFirst; frame <= last_; ++frame) {
      const CocFunction coc = pull_.coc(frame);
      const Stats stats = incremental->filter(pull_.frame(), coc);
      if (frame > kFirst) {
        const Stats& full = linear->filter(pull_.frame(), coc);
        of_incremental.push_back(stats.filter_ms);
        of_linear.push_back(full.filter_ms);
        updated += stats.updated;
        edges += stats.edges;
        linear_edges += full.edges;
      }
      const int nth = frame - kFirst;
      if (nth % every_ == 0) error.add(incremental->result(), truth_[static_cast<std::size_t>(nth / every_)]);
    }
    const double all = static_cast<double>(window.pixels()) * (last_ - kFirst);
    return {step > 0 ? fmt::format("1/{:g}", 1 / step) : "0 (half a pixel)",
            fmt::format("{:.4f}", error.rmse()),
            fmt::format("{:.1f} dB", psnr(error.rmse())),
            fmt::format("{:.3f}", error.largest()),
            fmt::format("{:.1f} %", 100 * static_cast<double>(updated) / all),
            fmt::format("{:.2f}", static_cast<double>(edges) / static_cast<double>(linear_edges)),
            fmt::format("{:.2f}", ratio(of_incremental, of_linear).median)};
  }

 private:
  static constexpr int kFirst = 40;
  int threads_, every_, last_;
  Pull pull_;
  std::vector<ColourImage> truth_;  // of every `every_`th frame
};

void print(const Settings& settings, Report& report) {
  report.columns({"`--coc-step`", "RMSE", "PSNR, peak 1", "largest error", "pixels updated a frame", "edges / linear",
                  "time / linear"});
  const Measurement measurement(settings);
  for (const double step : {0., 1. / 128, 1. / 64, 1. / 32, 1. / 16, 1. / 8}) report.row(measurement.row(step));
  report.end();
}

}  // namespace

const Table kStepsTable{
    "steps", "Steps of the CoC",
    "`star-lateral` at 1920x1080 with nothing moving, f/12, CoC up to 79 px, focus from 40 to 48 mm over 100 frames, "
    "of these frames 40-60: error against kernels in steps of 1/8 px throughout; work of an incremental frame, "
    "counted, and median of its time, against a linear one's; no visibility.",
    "1", print};

}  // namespace pullfocus::cli::bench
