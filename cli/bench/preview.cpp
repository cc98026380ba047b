// [preview]: dragging focus, as the preview does it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/picture_error.h"
#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "preview/refinement.h"

namespace pullfocus::cli::bench {

namespace {

using preview::Refinement;

// Diameters in pixels are kScale (1/P - 1/U), in which 1/P begins at kInverseFocus.
constexpr float kInverseFocus = 1.2f;

CocFunction focused(float scale, float inverse_focus) { return {DepthKind::planar, scale, inverse_focus}; }

// The scene with depths that give its diameters at the first focus.
Frame scene(int width, int height, float scale) {
  Frame frame = planes_and_floor(width, height, scale);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      frame.depth.at(x, y) = 1 / (kInverseFocus - std::clamp(frame.depth.at(x, y) / scale, -1.f, 1.f));
    }
  }
  return frame;
}

double error(const Filter& filter, const Filter& exact) {
  PictureError error;
  error.add(filter.result(), exact.result());
  return error.rmse();
}

constexpr int kReach = 5;  // positions of the mouse to either side

struct Drag {
  std::vector<double> first_ms, updated, left, exact_ms, pictures;
};

// `turns` positions of the mouse, `step` pixels of diameter apart, back and forth; each one is let come to rest.
Drag measure(const Frame& frame, float scale, float step, int threads, int turns) {
  FilterOptions options;
  options.threads = threads;
  options.slice_edges = std::int64_t{1} << 24;  // as the preview
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto filter = make_incremental_filter(frame.window(), options, kernels);
  const auto linear = make_linear_filter(frame.window(), options, kernels);
  const Budget picture{Budget::Kind::time, Refinement::kPictureMs};
  Refinement refinement;
  Drag drag;
  filter->filter(frame, focused(scale, kInverseFocus));
  for (int turn = 1; turn <= turns; ++turn) {
    const int at = std::abs((turn + kReach) % (4 * kReach) - 2 * kReach) - kReach;  // -kReach .. kReach
    const CocFunction coc = focused(scale, kInverseFocus + static_cast<float>(at) * step / scale);
    linear->filter(frame, coc);
    const double before = error(*filter, *linear);
    refinement.begin(*filter, frame, coc, picture);
    const double after = error(*filter, *linear);
    const auto pixels = static_cast<double>(frame.window().pixels());
    const Stats first = refinement.stats();
    while (!refinement.is_exact()) refinement.go_on(*filter, picture, false, {});
    if (turn <= 2) continue;  // it gets to know the machine
    drag.first_ms.push_back(refinement.first_ms());
    drag.updated.push_back(100 * static_cast<double>(first.updated) / pixels);
    drag.left.push_back(before > 0 ? after / before : 0);
    drag.exact_ms.push_back(refinement.total_ms());
    drag.pictures.push_back(refinement.calls());
  }
  return drag;
}

void print(const Settings& settings, Report& report) {
  report.columns({"threads", "largest radius", "step of the diameter", "first picture, ms", "pixels updated, %",
                  "error left", "exact after, ms of filter time", "pictures until then"});
  const int width = settings.quick ? 320 : 1920, height = settings.quick ? 180 : 1080;
  std::vector<int> threads{settings.threads_or(2)};
  if (!settings.threads && settings.processors >= 4) threads.push_back(4);
  for (const int count : threads) {
    for (const float radius : {10.f, 20.f}) {
      for (const float step : {0.25f, 1.f}) {
        const float scale = 2 * radius - kReach * step;  // largest diameter at first; the rest is for the drag
        const Frame frame = scene(width, height, scale);
        const Drag drag = measure(frame, scale, step, count, settings.runs_or(20) + 2);
        report.row({fmt::format("{}", count), fmt::format("{:g}", radius), fmt::format("{:g}", step),
                    text(spread(drag.first_ms), 1), text(spread(drag.updated), 0), text(spread(drag.left), 2),
                    text(spread(drag.exact_ms), 0), text(spread(drag.pictures), 0)});
      }
    }
  }
  report.end();
}

}  // namespace

const Table kPreviewTable{
    "preview", "Dragging focus in the preview",
    "Filter time from a change of focus to the first picture, within a budget of 16 ms, and to the exact one; the "
    "error "
    "of the first picture (RMSE) in proportion to that of the picture before the change; 1920x1080, the scene of "
    "`naive`, half RGB, default settings; median (range) over the positions of a drag, each let come to rest.",
    "2, and 4 where there are as many processors", print};

}  // namespace pullfocus::cli::bench
