// [kernels]: what kernels cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/filter.h"

namespace pullfocus::cli::bench {

namespace {

// A six-bladed opening with a bright rim, as a picture.
KernelShape picture() {
  auto image = std::make_shared<AperturePicture>();
  image->width = image->height = 64;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double dx = (x - 31.5) / 32, dy = (y - 31.5) / 32;
      const double r = std::max({std::fabs(dx), std::fabs(0.5 * dx + 0.866 * dy), std::fabs(0.5 * dx - 0.866 * dy)});
      image->luminance.push_back(r > 0.85 ? 0.f : r > 0.7 ? 1.f : 0.6f);
    }
  }
  KernelShape shape;
  shape.kind = KernelShape::Kind::image;
  shape.picture = image;
  return shape;
}

void measure(const std::string& name, const KernelShape& shape, const Settings& settings, std::span<const float> radii,
             Report& report) {
  std::vector<std::string> cells{name};
  for (const float radius : radii) {
    const Frame frame = waves(settings.quick ? 96 : 960, settings.quick ? 54 : 540, 2 * radius);
    FilterOptions options;
    options.visibility.kind = VisibilityOptions::Kind::none;
    options.threads = settings.threads_or(1);
    options.kernel.max_coc_px = 2 * static_cast<double>(radius);
    const auto disc = make_linear_filter(frame.window(), options);
    options.kernel.shape = shape;
    const auto filter = make_linear_filter(frame.window(), options);
    double edges = 0;
    const std::vector<Times> times =
        in_turn(settings.runs_or(7), {[&] { return disc->filter(frame, kDepthIsCoc).filter_ms; },
                                      [&] {
                                        const Stats& stats = filter->filter(frame, kDepthIsCoc);
                                        edges = static_cast<double>(stats.edges);
                                        return stats.filter_ms;
                                      }});
    const std::size_t pixels = frame.window().pixels();
    cells.push_back(fmt::format("{:.0f}", edges / static_cast<double>(pixels)));
    cells.push_back(text(ns_a_pixel(times[1], pixels)));
    cells.push_back(fmt::format("{:.2f}", ratio(times[1], times[0]).median));
  }
  report.row(cells);
}

void print(const Settings& settings, Report& report) {
  const std::vector<float> radii = settings.quick ? std::vector{5.f, 20.f} : std::vector{5.f, 20.f, 80.f};
  std::vector<std::string> columns{"kernel"};
  for (const float r : radii) {
    columns.push_back(fmt::format("edges a source, R = {:g}", r));
    columns.insert(columns.end(), {"ns a pixel", "time / disc"});
  }
  report.columns(columns);
  for (const char* name : {"disc", "polygon:5", "polygon:6", "gaussian", "diffraction"})
    measure(name, KernelShape::parse(name), settings, radii, report);
  measure("image (hexagon with a rim)", picture(), settings, radii, report);
  report.end();
}

}  // namespace

const Table kKernelsTable{
    "kernels", "Kernels",
    "Run edges a source, counted, and medians of the time of linear frames of 960x540 in which every pixel has a "
    "radius of 14/16 R to R, in turn with the disc's; half RGB, no visibility.",
    "1", print};

}  // namespace pullfocus::cli::bench
