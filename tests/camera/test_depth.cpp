#include "camera/depth.h"

#include <gtest/gtest.h>

#include <limits>

#include "usage.h"

namespace pullfocus {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

TEST(Depth, PlanarBackgroundIsNonFiniteNotPositiveOrHuge) {
  for (float depth : {nan_value, inf, -inf, 0.0f, -0.0f, -1.0f, 1.0e9f, 1.0e10f})
    EXPECT_TRUE(is_background(DepthKind::planar, depth)) << depth;
  for (float depth : {1.0e-30f, 0.5f, 0.99e9f}) EXPECT_FALSE(is_background(DepthKind::planar, depth)) << depth;
}

TEST(Depth, CocBackgroundIsNonFiniteOnly) {
  for (float depth : {nan_value, inf, -inf}) EXPECT_TRUE(is_background(DepthKind::coc, depth)) << depth;
  for (float depth : {0.0f, -80.0f, 1.0e10f}) EXPECT_FALSE(is_background(DepthKind::coc, depth)) << depth;
}

TEST(Depth, PlanarSuspectsAreNanNegativeAndZeroUnderColour) {
  for (bool alpha_positive : {false, true}) {
    for (float depth : {nan_value, -inf, -1.0f}) EXPECT_TRUE(is_suspect(DepthKind::planar, depth, alpha_positive));
    for (float depth : {1.0f, 1.0e9f, 1.0e10f, inf})
      EXPECT_FALSE(is_suspect(DepthKind::planar, depth, alpha_positive)) << depth;
    EXPECT_EQ(is_suspect(DepthKind::planar, 0.0f, alpha_positive), alpha_positive);
    EXPECT_EQ(is_suspect(DepthKind::planar, -0.0f, alpha_positive), alpha_positive);
  }
}

TEST(Depth, CocSuspectsAreNanAndMinusInfinity) {
  for (bool alpha_positive : {false, true}) {
    for (float depth : {nan_value, -inf}) EXPECT_TRUE(is_suspect(DepthKind::coc, depth, alpha_positive));
    for (float depth : {0.0f, -80.0f, 80.0f, inf})
      EXPECT_FALSE(is_suspect(DepthKind::coc, depth, alpha_positive)) << depth;
  }
}

TEST(Depth, FillerIsBackgroundAndNeverSuspect) {
  for (DepthKind kind : {DepthKind::planar, DepthKind::coc}) {
    EXPECT_TRUE(is_background(kind, background_depth(kind)));
    EXPECT_FALSE(is_suspect(kind, background_depth(kind), true));
  }
}

TEST(Depth, KindNamesParseBack) {
  for (DepthKind kind : {DepthKind::planar, DepthKind::coc}) EXPECT_EQ(parse_depth_kind(name(kind)), kind);
  expect_usage_error([] { parse_depth_kind("zbuffer"); }, "--depth-kind: 'zbuffer' is not one of planar, coc");
}

}  // namespace
}  // namespace pullfocus
