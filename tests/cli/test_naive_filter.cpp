// The yardstick of `pullfocus bench` computes the same picture as the filter it is compared with.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <random>

#include "bench/naive_filter.h"
#include "filter/filter.h"
#include "targets.h"

namespace pullfocus::cli::bench {
namespace {

Frame random_frame(std::mt19937& random, int width, int height, float largest_coc, SampleType type) {
  std::uniform_real_distribution<float> uniform(0, 1);
  const Window window{-3, 5, width - 3, height + 5};
  Frame frame;
  frame.colour.reset(window, type);
  frame.depth.reset(window, 0);
  frame.has_alpha = false;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      frame.depth.at(x, y) = (2 * uniform(random) - 1) * largest_coc;
      for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, uniform(random));
      frame.colour.set(x, y, 3, 1);
    }
  }
  return frame;
}

template <typename Real>
double largest_difference(const std::vector<Real>& naive, const ColourImage& exact, int border) {
  const Window& w = exact.window();
  double largest = 0;
  for (int y = w.y0 + border; y < w.y1 - border; ++y) {
    for (int x = w.x0 + border; x < w.x1 - border; ++x) {
      const auto at = static_cast<std::size_t>(y - w.y0) * static_cast<std::size_t>(w.width()) + (x - w.x0);
      for (int c = 0; c < 4; ++c) {
        const double difference = static_cast<double>(naive[at * 4 + c]) - static_cast<double>(exact.get(x, y, c));
        largest = std::max(largest, std::fabs(difference));
      }
    }
  }
  return largest;
}

// Colours up to 1. `tolerance`: of doubles, the rounding of float results and the 2^-40 of weights; of floats, that of
// sums of up to some hundred contributions.
template <typename Real>
void agrees_with_linear(double tolerance) {
  std::mt19937 random(11);
  for (const char* kernel : {"disc", "gaussian"}) {
    for (const float largest_coc : {0.5f, 5.f, 21.f}) {
      FilterOptions options;
      options.kernel.shape = KernelShape::parse(kernel);
      options.kernel.max_coc_px = 22;
      options.visibility.kind = VisibilityOptions::Kind::none;
      options.output_type = SampleType::float32;
      options.threads = 2;
      const auto kernels = std::make_shared<const KernelTable>(options.kernel);
      const int border = kernels->kernel(kernels->coc().index(largest_coc)).radius_x;
      const Frame frame =
          random_frame(random, 103, 141, largest_coc, largest_coc > 5 ? SampleType::half : SampleType::float32);
      const CocFunction coc{DepthKind::coc, 1, 0};
      const auto linear = make_linear_filter(frame.window(), options, kernels);
      linear->filter(frame, coc);
      for (const Way way : {Way::by_source, Way::by_row}) {
        NaiveFilter<Real> naive(*kernels, way);
        tbb::task_arena arena(2);
        std::vector<Real> result;
        for (int frames = 0; frames < 2; ++frames) arena.execute([&] { result = naive.filter(frame, coc); });
        EXPECT_LT(largest_difference(result, linear->result(), border), tolerance)
            << kernel << ", CoC up to " << largest_coc << (way == Way::by_row ? ", by row" : ", by source");
      }
    }
  }
}

TEST(NaiveFilter, AgreesWithLinearAwayFromTheBorderOnEveryTargetAndInBothWays) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    agrees_with_linear<double>(1e-7);
    agrees_with_linear<float>(5e-6);
    ASSERT_FALSE(HasFailure()) << "on " << test::simd_target_name(target);
  }
}

}  // namespace
}  // namespace pullfocus::cli::bench
