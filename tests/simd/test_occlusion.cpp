// Depth keys and occlusion masks against plain loops, on every SIMD target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "scatter/depth_key.h"
#include "scatter/occluded_edges.h"
#include "targets.h"

namespace pullfocus {
namespace {

// As scatter/depth_key.h describes them, from the number itself.
std::uint16_t plain_key(DepthKind kind, float depth) {
  if (is_background(kind, depth)) return kBackgroundKey;
  const auto z = static_cast<double>(depth);
  if (kind == DepthKind::coc) return static_cast<std::uint16_t>(std::floor(std::clamp(z, -511., 511.) * 64) + 32768);
  int exponent = 0;
  const double mantissa = std::frexp(z, &exponent) * 2 - 1;  // z = (1 + mantissa) * 2^(exponent - 1)
  const double steps = (exponent - 1 + 33) * 1024. + std::floor(mantissa * 1024);
  return static_cast<std::uint16_t>(std::max(steps, 0.));
}

std::vector<float> some_depths(std::mt19937& random) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  std::vector<float> depths{0,        -0.f,    inf,         -inf,  std::numeric_limits<float>::quiet_NaN(),
                            1e-42f,   1e9f,    999999936.f, 1e30f, 511,
                            -511,     510.99f, -600,        600,   0x1p-33f,
                            0x1p-34f, 1};
  std::uniform_real_distribution<float> exponent(-40, 35), coc(-520, 520);
  while (depths.size() < 400) depths.push_back(std::exp2(exponent(random)));
  while (depths.size() < 800) depths.push_back(coc(random));
  std::shuffle(depths.begin(), depths.end(), random);
  return depths;
}

TEST(DepthKeys, EqualPlainOnesForEveryKindAndLength) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937 random(1);
    for (const DepthKind kind : {DepthKind::planar, DepthKind::coc}) {
      const std::vector<float> depths = some_depths(random);
      for (int n = 1; n <= 64; ++n) {
        for (std::size_t at = 0; at + 64 <= depths.size(); at += 29) {
          std::uint16_t keys[66];
          std::fill_n(keys, 66, std::uint16_t{12345});
          depth_keys(kind, &depths[at], n, keys + 1);
          for (int i = 0; i < n; ++i) {
            ASSERT_EQ(keys[i + 1], plain_key(kind, depths[at + static_cast<std::size_t>(i)]))
                << test::simd_target_name(target) << " " << depths[at + static_cast<std::size_t>(i)];
          }
          ASSERT_EQ(keys[0], 12345);
          ASSERT_EQ(keys[n + 1], 12345);
        }
      }
    }
  }
}

TEST(DepthKeys, GrowWithDepthAndTellDepthsAPartInAThousandApart) {
  std::mt19937 random(2);
  for (const DepthKind kind : {DepthKind::planar, DepthKind::coc}) {
    std::vector<float> depths = some_depths(random);
    std::erase_if(depths, [&](float z) { return is_background(kind, z); });
    std::sort(depths.begin(), depths.end());
    for (std::size_t i = 1; i < depths.size(); ++i) {
      ASSERT_LE(depth_key(kind, depths[i - 1]), depth_key(kind, depths[i]));
      ASSERT_LT(depth_key(kind, depths[i]), kBackgroundKey);
    }
  }
  for (float z = 1e-6f; z < 1e8f; z *= 1.37f) {
    EXPECT_LT(depth_key(DepthKind::planar, z), depth_key(DepthKind::planar, z * 1.001f));
  }
}

TEST(CellRanges, EqualPlainOnesForAnyHeight) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937 random(4);
    std::vector<std::uint16_t> values(40 * 21);
    for (int trial = 0; trial < 100; ++trial) {
      for (std::uint16_t& value : values) value = static_cast<std::uint16_t>(random());
      const int rows = 1 + trial % 16;
      std::uint16_t least = 0xffff, most = 0;
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < kCellWidth; ++x) {
          least = std::min(least, values[static_cast<std::size_t>(40 * y + 3 + x)]);
          most = std::max(most, values[static_cast<std::size_t>(40 * y + 3 + x)]);
        }
      }
      const ValueRange range = range_of_cell(&values[3], 40, rows);
      ASSERT_EQ(range.least, least) << test::simd_target_name(target);
      ASSERT_EQ(range.most, most) << test::simd_target_name(target);
    }
  }
}

TEST(OcclusionMasks, EqualPlainOnesForAnyLength) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937 random(3);
    const auto below = [&](int n) { return static_cast<std::uint16_t>(random() % static_cast<unsigned>(n)); };
    for (int trial = 0; trial < 40; ++trial) {
      for (int n = 1; n <= 64; ++n) {
        std::uint16_t keys[96], sizes[96];
        const std::uint16_t base = trial % 2 == 0 ? 0 : 0xfff0;  // keys compare as unsigned numbers
        for (int i = 0; i < 96; ++i) {
          keys[i] = static_cast<std::uint16_t>(base + below(16) - (below(9) == 0 ? 0x8000 : 0));
          sizes[i] = below(40);
        }
        const std::uint16_t key = keys[below(96)];
        const NearSizes near{below(30), below(20)};
        std::uint64_t in_front = 0, behind = 0;
        for (int i = 0; i < n; ++i) {
          const bool unlike = sizes[i] < near.first || sizes[i] > near.first + near.span;
          in_front |= std::uint64_t{unlike && keys[i] < key} << i;
          behind |= std::uint64_t{unlike && keys[i] > key} << i;
        }
        ASSERT_EQ(hidden_by(keys, sizes, n, key, near), in_front) << test::simd_target_name(target) << " " << n;
        ASSERT_EQ(hidden_from(keys, sizes, n, key, near), behind) << test::simd_target_name(target) << " " << n;
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
