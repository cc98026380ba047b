// Lenses and depths at their limits: focus and surfaces at the focal length and at infinity, coarse depths, and the
// first steps of blur.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "camera/usage.h"
#include "hard_measures.h"
#include "plain_frames.h"

namespace pullfocus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Raster raster{1920, 1080, 1};

// F = 50 mm at f/2 on 36 mm, distances in metres.
CocFunction coc_of(LensModel model, double focus) {
  ThinLens lens{50, 2, focus};
  lens.model = model;
  return coc_function(lens, raster, DepthKind::planar);
}

TEST(HardLens, WhatIsInFocusHasNoBlurWhileFocusPassesF) {
  for (int mm = 20; mm <= 120; ++mm) {
    const double focus = mm / 1000.;
    EXPECT_EQ(coc_of(LensModel::render, focus)(static_cast<float>(focus)), 0.f) << mm;
    if (mm > 50) {
      EXPECT_EQ(coc_of(LensModel::paper, focus)(static_cast<float>(focus)), 0.f) << mm;
    }
  }
}

TEST(HardLens, BlurIsContinuousAndMonotoneOverASurfaceThatPassesF) {
  for (const double focus : {0.03, 0.05, 0.4, infinity}) {
    const CocFunction coc = coc_of(LensModel::render, focus);
    float before = coc(0.0499f);
    for (float u = std::nextafter(0.0499f, 1.f); u < 0.0501f; u = std::nextafter(u, 1.f)) {
      const float is = coc(u);
      ASSERT_TRUE(std::isfinite(is));
      ASSERT_GE(is, before);
      ASSERT_LE(is - before, 0.001f) << "at " << u;
      before = is;
    }
  }
}

TEST(HardLens, ThePapersLensTakesEveryFocusBeyondFAndRefusesF) {
  const auto refused = [](double focus) {
    ThinLens lens{50, 2, focus};
    lens.model = LensModel::paper;
    expect_usage_error([&] { coc_function(lens, raster, DepthKind::planar); }, "beyond the focal length");
  };
  refused(0.05);
  refused(std::nextafter(0.05, 0.));
  const KernelTable kernels(KernelOptions{});
  for (int i = 1; i <= 50; ++i) {
    const CocFunction coc = coc_of(LensModel::paper, 0.05 * (1 + std::ldexp(1., -i)));
    EXPECT_TRUE(std::isfinite(coc(0.2f)) && std::isfinite(coc.background())) << "2^-" << i;
    if (i >= 12) {
      EXPECT_EQ(kernels.coc().index(coc(0.2f)), kernels.coc().size() - 1) << "2^-" << i;
    }
    if (i >= 12) {
      EXPECT_EQ(kernels.coc().index(coc(0.04f)), 1 - kernels.coc().size()) << "2^-" << i;
    }
  }
}

TEST(HardLens, FocusedAtInfinityTheBackgroundIsSharpAndTheRestInFront) {
  for (const LensModel model : {LensModel::render, LensModel::paper}) {
    const CocFunction coc = coc_of(model, infinity);
    EXPECT_EQ(coc.background(), 0.f);
    EXPECT_EQ(coc(std::numeric_limits<float>::infinity()), 0.f);
    for (const float u : {1e-45f, 1e-30f, 1e-3f, 0.05f, 1.f, 9e8f}) EXPECT_LT(coc(u), 0.f) << u;
  }
}

TEST(HardLens, NoDepthAtAllLeavesTheTable) {
  const KernelTable kernels(KernelOptions{});
  const int last = kernels.coc().size() - 1;
  for (const double focus : {0.05, 1e-30, 3., 1e38, 1e300, infinity}) {
    const CocFunction coc = coc_of(LensModel::render, focus);
    for (std::uint64_t bits = 0; bits < 1ull << 32; bits += 65521) {
      const float depth = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      const float c = is_background(coc.kind, depth) ? coc.background() : coc(depth);
      ASSERT_FALSE(std::isnan(c)) << depth;
      ASSERT_LE(std::abs(kernels.coc().index(c)), last) << depth;
    }
  }
}

TEST(HardSteps, BlurSetsInWithoutAPopAndOnlyDimsAPoint) {
  // An ideal disc over square pixels moves an edge by D / (3 pi) px, so by 0.053 per half pixel.
  constexpr double ideal = 0.5 / (3 * 3.14159265358979);
  for (const test::TableStep& step : test::table_steps(64)) {
    EXPECT_LE(step.edge, 1.5 * ideal) << step.from_px << " to " << step.to_px << " px";
    EXPECT_LE(step.point, step.to_px <= 2 ? 0.27 : 0.18) << step.from_px << " to " << step.to_px << " px";
    EXPECT_TRUE(step.dims_point) << step.from_px << " to " << step.to_px << " px";
    if (step.from_px >= 6) {
      EXPECT_LE(step.edge, 0.03) << step.from_px << " to " << step.to_px << " px";
    }
    if (step.from_px >= 6) {
      EXPECT_LE(step.point, 0.007) << step.from_px << " to " << step.to_px << " px";
    }
  }
}

TEST(HardSteps, TerracesOfHalfDepthMoveThePictureByLessThanHalfTheLargestTableStep) {
  double largest_step = 0;
  for (const test::TableStep& step : test::table_steps(30)) largest_step = std::max(largest_step, step.edge);
  const test::Terraces is = test::half_terraces();
  EXPECT_LE(is.largest_index, 1);
  EXPECT_GT(is.share, 0) << "the case is too easy";
  EXPECT_LE(is.picture, largest_step / 2);
}

}  // namespace
}  // namespace pullfocus
