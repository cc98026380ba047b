// Artistic multipliers of the circle of confusion.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "camera/thin_lens.h"
#include "usage.h"

namespace pullfocus {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const ThinLens lens{50, 2, 3};
const Raster raster{1920, 1080};

// Depths of every magnitude, tiny and infinite ones included.
template <typename Check>
void for_many_depths(Check&& check) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const float any = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0x7fffffffu);
    check(std::isnan(any) ? infinity : i % 2 ? any : std::uniform_real_distribution<float>(0.1f, 30)(random));
  }
  check(3.f);
}

TEST(CocScale, OneLeavesEveryBit) {
  for (const DepthKind kind : {DepthKind::planar, DepthKind::coc}) {
    const CocFunction plain = coc_function(lens, raster, kind), one = coc_function(lens, raster, kind, {1, 1});
    for_many_depths([&](float depth) {
      for (const float d : {depth, kind == DepthKind::coc ? -depth : depth}) {
        const float expected = kind == DepthKind::coc ? d : plain.scale * (plain.inverse_focus - 1 / d);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(one(d)), std::bit_cast<std::uint32_t>(expected)) << d;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(plain(d)), std::bit_cast<std::uint32_t>(expected)) << d;
      }
    });
    EXPECT_EQ(one.background(), plain.background());
  }
}

TEST(CocScale, MultipliesTheDiameterOnItsOwnSideOfFocusOnly) {
  const CocFunction plain = coc_function(lens, raster, DepthKind::planar);
  const CocFunction scaled = coc_function(lens, raster, DepthKind::planar, {0.5f, 3});
  for (const float depth : {0.2f, 1.f, 2.9f}) {
    ASSERT_LT(plain(depth), 0);
    EXPECT_EQ(scaled(depth), 0.5f * plain(depth));
  }
  for (const float depth : {3.1f, 8.f, infinity}) {
    ASSERT_GT(plain(depth), 0);
    EXPECT_EQ(scaled(depth), 3 * plain(depth));
  }
  EXPECT_EQ(scaled(3), 0);
  EXPECT_EQ(scaled.background(), 3 * plain.background());
  const CocFunction as_diameter = coc_function({}, {}, DepthKind::coc, {0.5f, 3});
  EXPECT_EQ(as_diameter(-8), -4);
  EXPECT_EQ(as_diameter(8), 24);
  EXPECT_EQ(as_diameter.background(), 0);
}

TEST(CocScale, ZeroMakesItsSideSharpAtEveryDepth) {
  const CocFunction near_sharp = coc_function(lens, raster, DepthKind::planar, {0, 1});
  const CocFunction far_sharp = coc_function(lens, raster, DepthKind::planar, {1, 0});
  for_many_depths([&](float depth) {
    if (depth == 0) return;  // background
    ASSERT_GE(near_sharp(depth), 0) << depth;
    ASSERT_LE(far_sharp(depth), 0) << depth;
  });
  EXPECT_EQ(far_sharp.background(), 0);
}

TEST(CocScale, NegativeAndInfiniteFactorsAreRefusedByName) {
  for (const float wrong : {-1.f, infinity, std::numeric_limits<float>::quiet_NaN()}) {
    for (const DepthKind kind : {DepthKind::planar, DepthKind::coc}) {
      expect_usage_error([&] { coc_function(lens, raster, kind, {wrong, 1}); }, "--near-scale");
      expect_usage_error([&] { coc_function(lens, raster, kind, {1, wrong}); }, "--far-scale");
    }
  }
}

}  // namespace
}  // namespace pullfocus
