// [paper]: tables 1 and 2 of P. Fearing, "Importance Ordering for Real-Time Depth of Field", 1996, section 6.1, beside
// the same quantities here.
#include <fmt/format.h>

#include "bench/shot_run.h"
#include "bench/table.h"
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

// The paper's filters are gaussian, with tables in steps of half a pixel, and plain.
FilterOptions options_for(const char* kernel, const char* visibility, int threads) {
  FilterOptions options;
  options.threads = threads;
  options.kernel.shape = KernelShape::parse(kernel);
  options.kernel.max_coc_px = 100;
  if (options.kernel.shape.kind == KernelShape::Kind::gaussian) options.kernel.coc_step = 0;
  options.visibility = parse_visibility(visibility);
  return options;
}

void print(const Settings& settings, Report& report) {
  report.columns({"experiment", "paper: linear, s", "importance, s", "speed-up without first frame", "with it",
                  "here: kernel", "visibility", "linear, ms", "incremental, ms", "speed-up without first frame",
                  "with it"});
  int number = 0;
  for (const Experiment& e : kExperiments) {
    const Sequence shot = render(e.shot, settings.quick ? 64 : 256, settings.quick ? 3 : 100);
    ++number;
    for (const char* kernel : {"disc", "gaussian"}) {
      for (const char* visibility : {"layers", "none"}) {
        const ShotSpeed speed = speed_of(shot.frames, shot.coc, options_for(kernel, visibility, settings.threads_or(1)),
                                         settings.runs_or(3));
        report.row({fmt::format("{}", number), e.linear_s, e.importance_s, e.without_first, e.with_first, kernel,
                    visibility, text(speed.linear_ms), text(speed.incremental_ms), text(speed.without_first, 1),
                    fmt::format("{:.1f}", speed.with_first.median)});
      }
    }
  }
  report.end();
}

}  // namespace

const Table kPaperTable{
    "paper", "The paper's tables 1 and 2",
    "Fearing's experiments at 256x256, 100 frames from `pullfocus render`'s shots `fearing-1` to `fearing-5` in "
    "memory, full budget: time a frame, mean over frames 2-100 (table 2), and speed-up without and with the first "
    "frame (table 1), linear and incremental frame by frame in turn; gaussians in steps of half a pixel as in the "
    "paper, discs in the default steps; median (range) of whole runs.",
    "1", print};

}  // namespace pullfocus::cli::bench
