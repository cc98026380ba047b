// What kernels cost: edges a source, counted, and the time of a linear frame relative to the disc's, frames of both in
// turn. Prints a Markdown table; judges nothing.
//
//   kernels [--quick] [--threads N]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>

#include "filter/filter.h"
#include "measure.h"

namespace {

using namespace pullfocus;

// Every pixel has a diameter within 1/16 of the largest, in smooth waves.
Frame waves(int width, int height, float radius) {
  Frame frame;
  frame.colour.reset({0, 0, width, height}, SampleType::half);
  frame.depth.reset({0, 0, width, height}, 0);
  frame.has_alpha = false;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float wave = std::sin(static_cast<float>(x) / 40) * std::sin(static_cast<float>(y) / 30);
      frame.depth.at(x, y) = 2 * radius * (1 + wave / 16) / (1 + 1.f / 16);
      for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, uniform(random));
      frame.colour.set(x, y, 3, 1);
    }
  }
  return frame;
}

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

using test::median;

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  int threads = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) quick = true;
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) threads = std::atoi(argv[++i]);
  }
  const int width = quick ? 96 : 960, height = quick ? 54 : 540, runs = quick ? 1 : 7;
  const std::vector<float> radii{5, 20, 80};
  std::vector<std::pair<std::string, KernelShape>> shapes;
  for (const char* text : {"disc", "polygon:5", "polygon:6", "gaussian", "diffraction"}) {
    shapes.emplace_back(text, KernelShape::parse(text));
  }
  shapes.emplace_back("image (hexagon with a rim)", picture());

  fmt::print("{}x{}, {} threads, radii 14/16 R to R, half RGB\n\n| kernel |", width, height, threads);
  for (const float r : radii) fmt::print(" edges a source, R = {:g} | time / disc |", r);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < 2 * radii.size(); ++i) fmt::print("---|");
  fmt::print("\n");
  for (const auto& [name, shape] : shapes) {
    fmt::print("| {} |", name);
    for (const float radius : radii) {
      const Frame frame = waves(width, height, radius);
      FilterOptions options;
      options.visibility.kind = VisibilityOptions::Kind::none;
      options.threads = threads;
      const auto disc = make_linear_filter(frame.window(), options);
      options.kernel.shape = shape;
      const auto filter = make_linear_filter(frame.window(), options);
      const CocFunction coc{DepthKind::coc, 1, 0};
      std::vector<double> ratios;
      for (int run = 0; run <= runs; ++run) {
        const double disc_ms = disc->filter(frame, coc).filter_ms;
        const double ms = filter->filter(frame, coc).filter_ms;
        if (run > 0) ratios.push_back(ms / disc_ms);
      }
      const Stats& stats = filter->filter(frame, coc);
      fmt::print(" {:.0f} | {:.2f} |", static_cast<double>(stats.edges) / static_cast<double>(frame.window().pixels()),
                 median(ratios));
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
  return 0;
}
