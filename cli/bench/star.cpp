// [star]: the paper's experiment 1 without a renderer, by threads.
#include "star_lateral.h"

#include <fmt/format.h>

#include <set>

#include "bench/shot_run.h"
#include "bench/table.h"

namespace pullfocus::cli::bench {

namespace {

void print(const Settings& settings, Report& report) {
  const sequences::StarLateral shot;
  const sequences::StarLateralRenderer renderer(shot);
  std::vector<Frame> frames(settings.quick ? 3 : 100);
  for (std::size_t i = 0; i < frames.size(); ++i) renderer.render(static_cast<int>(i) + 1, frames[i]);
  const Window& window = frames[0].window();
  const std::vector<CocFunction> coc(
      frames.size(), coc_function(sequences::star_lens(shot), {window.width(), window.height(), 1}, DepthKind::planar));
  const int processors = settings.processors;
  const std::set<int> threads =
      settings.threads ? std::set{*settings.threads} : std::set{1, std::max(1, processors / 2), processors};
  report.columns({"visibility", "threads", "linear / incremental", "linear, ms", "incremental, ms"});
  for (const char* visibility : {"layers", "none"}) {
    for (const int n : threads) {
      FilterOptions options;
      options.threads = n;
      options.visibility = parse_visibility(visibility);
      const ShotSpeed speed = speed_of(frames, coc, options, settings.runs_or(9));
      report.row({visibility, fmt::format("{}", n), text(speed.without_first, 1), text(speed.linear_ms),
                  text(speed.incremental_ms)});
    }
  }
  report.end();
}

}  // namespace

const Table kStarTable{
    "star", "The star, by threads",
    "`star-lateral` at 256x256 (the paper's experiment 1: F = 8 mm, n = 3.5, focused at 40 mm, `--lens paper`), "
    "kernels up to 64 px: filter time a frame, mean over frames 2-100, linear and incremental frame by frame in turn; "
    "median (range) of whole runs.",
    "1, half of the processors and all", print};

}  // namespace pullfocus::cli::bench
