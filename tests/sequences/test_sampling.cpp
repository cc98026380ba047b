#include "render/sampling.h"

#include <gtest/gtest.h>

#include <vector>

namespace pullfocus::sequences::test {
namespace {

TEST(Sampling, EveryPowerOfTwoOfLensPointsFillsAllElementaryIntervalsOnce) {
  const SamplePattern pattern(256);
  for (const std::uint32_t seed : {0u, 1u, 77u, 0xffffffffu}) {
    for (std::uint32_t bits = 0; bits <= 8; ++bits)
      for (std::uint32_t columns = 0; columns <= bits; ++columns) {
        const auto width = static_cast<float>(1u << columns), height = static_cast<float>(1u << (bits - columns));
        std::vector<int> points(std::size_t{1} << bits, 0);
        for (std::uint32_t i = 0; i < points.size(); ++i) {
          const glm::vec2 p = pattern.lens(i, seed);
          ++points[static_cast<std::size_t>(p.x * width) * (1u << (bits - columns)) +
                   static_cast<std::size_t>(p.y * height)];
        }
        for (const int count : points) ASSERT_EQ(count, 1) << seed << ' ' << bits << ' ' << columns;
      }
  }
}

TEST(Sampling, PixelPointsAreStratifiedEachWay) {
  const SamplePattern pattern(64);
  for (const std::uint32_t seed : {0u, 5u})
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<int> points(64, 0);
      for (std::size_t i = 0; i < 64; ++i) ++points[static_cast<std::size_t>(pattern.pixel(i, seed)[axis] * 64)];
      for (const int count : points) ASSERT_EQ(count, 1);
    }
}

TEST(Sampling, PixelAndLensAreIndependent) {
  const SamplePattern pattern(16);
  double product = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    for (std::uint32_t i = 0; i < 16; ++i)
      product += static_cast<double>((pattern.pixel(i, seed).x - 0.5f) * (pattern.lens(i, seed).x - 0.5f));
  }
  EXPECT_NEAR(product / 6400, 0, 0.004);  // 1/12 if equal; one standard deviation is 0.001
}

TEST(Sampling, ConcentricMapKeepsAreas) {
  int inside[3] = {0, 0, 0};
  constexpr int side = 400;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const glm::vec2 p =
          concentric_disc({(static_cast<float>(i) + 0.5f) / side, (static_cast<float>(j) + 0.5f) / side});
      const float square = p.x * p.x + p.y * p.y;
      ASSERT_LE(square, 1.00001f);
      inside[0] += square < 0.25f;
      inside[1] += p.x > 0 && p.y > 0;
      inside[2] += p.y > std::abs(p.x);
    }
  for (const int count : inside) EXPECT_NEAR(count, side * side / 4, side);
}

}  // namespace
}  // namespace pullfocus::sequences::test
