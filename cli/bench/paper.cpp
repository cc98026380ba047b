// [paper]: tables 1 and 2 of P. Fearing, "Importance Ordering for Real-Time Depth of Field", 1996, section 6.1, beside
// the same quantities here.
#include <fmt/format.h>

#include "bench/picture_error.h"
#include "bench/shot_run.h"
#include "bench/table.h"
#include "filter/filter.h"
#include "image/error.h"
#include "render/renderer.h"
#include "shots_folder.h"

namespace pullfocus::cli::bench {

namespace {

struct Experiment {
  const char* shot;
  const char* linear_s;  // a frame, table 2
  const char* importance_s;
  const char* with_first;     // speed-up of all 100 frames, table 1
  const char* without_first;  // of frames 2..100, table 2
};

// The paper gives no times of its fifth experiment at the full budget.
constexpr Experiment kExperiments[] = {{"fearing-1", "25.7", "0.9", "22.1", "28.5"},
                                       {"fearing-2", "11.6", "0.8", "13.4", "14.5"},
                                       {"fearing-3", "4.8", "1.9", "2.4", "2.5"},
                                       {"fearing-4", "5.0", "1.9", "2.4", "2.6"},
                                       {"fearing-5", "-", "-", "-", "-"}};

struct Sequence {
  std::vector<Frame> frames;
  std::vector<CocFunction> coc;
};

Sequence render(const char* name, int side, std::size_t frames) {
  const std::string path = sequences::shot_path(shots_folder(), name);
  if (path.empty()) {
    throw Error(ErrorCode::unreadable,
                fmt::format("{}: has no shot {}: install the program with its shots", shots_folder(), name));
  }
  const sequences::ShotRenderer renderer(sequences::load_shot(path), side, side);
  sequences::StillPixels still;
  Sequence sequence;
  for (int i = 0; i < static_cast<int>(frames); ++i) {
    const int number = renderer.shot().first_frame + i;
    renderer.render(number, 16, sequence.frames.emplace_back(), &still);
    sequence.coc.push_back(coc_function(renderer.lens(number).lens, {side, side, 1}, DepthKind::planar));
  }
  return sequence;
}

// The paper's filters are gaussian, with tables in steps of half a pixel (coc_step 0), and plain.
struct Setting {
  const char* kernel;
  const char* visibility;
  double coc_step;
};
constexpr Setting kSettings[] = {{"disc", "layers", 1. / 32}, {"disc", "none", 1. / 32}, {"disc", "none", 1. / 4},
                                 {"gaussian", "layers", 0},   {"gaussian", "none", 0},   {"gaussian", "none", 1. / 6}};

FilterOptions options_for(const Setting& setting, int threads) {
  FilterOptions options;
  options.threads = threads;
  options.kernel.shape = KernelShape::parse(setting.kernel);
  options.kernel.max_coc_px = 100;
  options.kernel.coc_step = setting.coc_step;
  options.visibility = parse_visibility(setting.visibility);
  return options;
}

// Of the shot's linear frames, every tenth, against those in steps of half a pixel.
std::string error_of_steps(const Sequence& shot, FilterOptions options) {
  if (options.kernel.coc_step == 0) return "-";
  options.output_type = SampleType::float32;
  const auto filter = make_linear_filter(shot.frames[0].window(), options);
  options.kernel.coc_step = 0;
  const auto fine = make_linear_filter(shot.frames[0].window(), options);
  PictureError error;
  for (std::size_t i = 0; i < shot.frames.size(); i += 10) {
    filter->filter(shot.frames[i], shot.coc[i]);
    fine->filter(shot.frames[i], shot.coc[i]);
    error.add(filter->result(), fine->result());
  }
  return error.rmse() > 0 ? fmt::format("{:.1f} dB", psnr(error.rmse())) : "none";
}

void print(const Settings& settings, Report& report) {
  report.columns({"experiment", "paper: linear, s", "importance, s", "speed-up without first frame", "with it",
                  "here: kernel", "visibility", "`--coc-step`", "its error", "linear, ms", "incremental, ms",
                  "speed-up without first frame", "with it"});
  int number = 0;
  for (const Experiment& e : kExperiments) {
    const Sequence shot = render(e.shot, settings.quick ? 64 : 256, settings.quick ? 3 : 100);
    ++number;
    for (const Setting& setting : kSettings) {
      const FilterOptions options = options_for(setting, settings.threads_or(1));
      const ShotSpeed speed = speed_of(shot.frames, shot.coc, options, settings.runs_or(3));
      report.row({fmt::format("{}", number), e.linear_s, e.importance_s, e.without_first, e.with_first, setting.kernel,
                  setting.visibility, setting.coc_step > 0 ? fmt::format("1/{:g}", 1 / setting.coc_step) : "1/2 px",
                  error_of_steps(shot, options), text(speed.linear_ms), text(speed.incremental_ms),
                  text(speed.without_first, 1), fmt::format("{:.1f}", speed.with_first.median)});
    }
  }
  report.end();
}

}  // namespace

const Table kPaperTable{
    "paper", "The paper's tables 1 and 2",
    "Fearing's experiments at 256x256, 100 frames from `pullfocus render`'s shots `fearing-1` to `fearing-5` in "
    "memory, full budget: time a frame, mean over frames 2-100 (table 2), and speed-up without and with the first "
    "frame (table 1), linear and incremental frame by frame in turn; median (range) of whole runs. Gaussians in steps "
    "of half a pixel are the paper's; error: PSNR of linear frames against such steps, peak 1.",
    "1", print};

}  // namespace pullfocus::cli::bench
