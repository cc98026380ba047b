// Priorities of a row's pixels, against the same written pixel by pixel.
#include "importance/gain_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "importance/order.h"
#include "scatter/state.h"
#include "targets.h"

namespace pullfocus {
namespace {

constexpr int kKernels = 20;

struct Expected {
  float gain;
  bool as_block;
};

Expected plain_gain(const GainRow& row, int i) {
  float changed = 0, aa = 0, bb = 0, ab = 0;
  for (int c = 0; c < 3; ++c) {
    const float now = row.now.channel[c][i], then = row.then.channel[c][i], shown = row.shown.channel[c][i];
    const float d = now - then, a = now - shown, b = then - shown;
    changed += d * d;
    aa += a * a;
    bb += b * b;
    ab += a * b;
  }
  const std::int16_t is = row.is[i], was = row.was[i];
  const float area_now = row.areas[reach_index(is)], area_then = row.areas[reach_index(was)];
  const float of_colour = changed * std::sqrt(std::sqrt(std::max(area_now, area_then)));
  const float of_kernel = aa * area_now + bb * area_then - 2 * ab * std::min(area_now, area_then);
  const bool only_kernel = was != is && !(changed > 0);
  const bool as_block = only_kernel && std::max(area_now, area_then) * 8 <= 1;
  const float at_random =
      as_block ? row.of_block[i] : fraction_of(scrambled(row.first + static_cast<std::uint32_t>(i)));
  const float of_move = only_kernel ? of_kernel * at_random : std::max(of_kernel, of_colour);
  const float gain = was == is ? of_colour : of_move;
  constexpr float most = std::numeric_limits<float>::max();
  if (was == kNeverCommitted) return {kFirstOfAll, as_block};
  return {gain <= most ? std::max(gain, 0.f) : most, as_block};
}

class GainRows : public testing::Test {
 protected:
  GainRows() {
    for (int i = 0; i < kKernels; ++i) {
      const float area = std::max(1.f, 0.4f * static_cast<float>(i * i));
      areas_.push_back(1 / area);
    }
  }

  std::int16_t any_index() {
    const auto kind = random_() % 12;
    if (kind == 0) return kNeverCommitted;
    if (kind == 1) return kHeldOut;
    return static_cast<std::int16_t>(static_cast<int>(random_() % (2 * kKernels - 1)) - kKernels + 1);
  }

  // Some pixels keep their colour, some their kernel; some colours are so large that their squares are no numbers.
  GainRow any_row(bool huge) {
    std::uniform_real_distribution<float> exponent(-9, huge ? 120.f : 4.f);
    GainRow row;
    for (int i = 0; i < kTileWidth; ++i) {
      const bool same = random_() % 3 == 0;
      for (int c = 0; c < 3; ++c) {
        row.then.channel[c][i] = std::exp2(exponent(random_)) * (random_() % 4 == 0 ? -1.f : 1.f);
        row.now.channel[c][i] = same ? row.then.channel[c][i] : std::exp2(exponent(random_));
        row.shown.channel[c][i] = std::exp2(exponent(random_));
      }
      row.was[i] = any_index();
      row.is[i] = random_() % 3 == 0 ? row.was[i] : any_index();
      row.of_block[i] = fraction_of(static_cast<std::uint32_t>(random_()));
    }
    row.areas = areas_.data();
    row.first = static_cast<std::uint32_t>(random_());
    return row;
  }

  std::mt19937 random_{1};
  std::vector<float> areas_;
};

TEST_F(GainRows, HaveTheBitsOfTheFormulaPixelByPixelOnEveryTarget) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    for (int round = 0; round < 600; ++round) {
      const GainRow row = any_row(round % 4 == 0);
      const int n = round % 3 == 0 ? kTileWidth : 1 + static_cast<int>(random_() % kTileWidth);
      std::vector<float> out(static_cast<std::size_t>(n));  // so that a write beyond them shows where memory is checked
      const std::uint64_t blocks = gains(row, n, out.data());
      std::uint64_t expected_blocks = 0;
      for (int i = 0; i < n; ++i) {
        const Expected expected = plain_gain(row, i);
        expected_blocks |= std::uint64_t{expected.as_block} << i;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(out[static_cast<std::size_t>(i)]),
                  std::bit_cast<std::uint32_t>(expected.gain))
            << test::simd_target_name(target) << ", pixel " << i << " of " << n << ", round " << round;
      }
      ASSERT_EQ(blocks, expected_blocks) << test::simd_target_name(target) << ", " << n << " pixels";
    }
  }
}

template <SampleType type>
void expect_planes(std::mt19937& random) {
  for (int n = 1; n <= kTileWidth; ++n) {
    std::vector<Pixel<type>> pixels(static_cast<std::size_t>(n));
    for (Pixel<type>& pixel : pixels) {
      for (auto& sample : pixel.rgba) {
        constexpr bool is_half = sizeof sample == 2;
        const auto bits = static_cast<std::uint32_t>(random());
        if constexpr (is_half) {
          sample = static_cast<std::uint16_t>((bits & 0x7c00) == 0x7c00 ? bits ^ 0x4000 : bits);
        } else {
          sample = bits & ~0x40000000u;  // no exponent of all ones
        }
      }
    }
    PlanarRow planes;
    to_planes(pixels.data(), n, planes);
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(planes.channel[c][i]),
                  std::bit_cast<std::uint32_t>(sample_value(pixels[static_cast<std::size_t>(i)].rgba[c])))
            << "pixel " << i << " of " << n;
      }
    }
  }
}

TEST_F(GainRows, ReadPixelsOfAnyFiniteValueOnEveryTarget) {
  for (const std::int64_t target : test::simd_targets()) {
    SCOPED_TRACE(test::simd_target_name(target));
    const test::OnTarget on(target);
    expect_planes<SampleType::half>(random_);
    expect_planes<SampleType::float32>(random_);
  }
}

}  // namespace
}  // namespace pullfocus
