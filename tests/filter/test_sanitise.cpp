// Single colours: what is taken over, what is repaired, and how halves become floats.
#include <Imath/half.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "image/sanitise.h"

namespace pullfocus {
namespace {

// The largest half that does not exceed `limit`.
float half_below(float limit) {
  float largest = 0;
  for (std::uint16_t bits = 0; bits <= 0x7bff; ++bits) {
    const float value = imath_half_to_float(bits);
    if (value <= limit) largest = std::max(largest, value);
  }
  return largest;
}

struct Expected {
  float value;
  bool not_finite, clamped;
};

Expected sanitised(float value, float largest) {
  if (!std::isfinite(value)) return {0.f, true, false};
  if (std::fabs(value) > largest) return {std::copysign(largest, value), false, true};
  return {value, false, false};
}

constexpr float limits[] = {65504.f, 65519.f, 1e5f, 3e38f, 100.03f, 1.f, 0.3f, 1e-6f};

TEST(Sanitiser, TreatsEveryHalfAsAPlainComparisonDoes) {
  for (const float limit : limits) {
    const Sanitiser sanitise(limit);
    const float largest = half_below(limit);
    for (int bits = 0; bits < 65536; ++bits) {
      const auto sample = static_cast<std::uint16_t>(bits);
      const Expected expected = sanitised(imath_half_to_float(sample), largest);
      for (int channel = 0; channel < 3; ++channel) {
        Pixel<SampleType::half> pixel{};
        pixel.rgba[channel] = sample;
        ColourRepairs repairs;
        const auto is = sanitise(pixel, repairs);
        ASSERT_EQ(is.rgba[channel], imath_float_to_half(expected.value)) << "half " << bits << ", limit " << limit;
        ASSERT_EQ(repairs.not_finite, expected.not_finite);
        ASSERT_EQ(repairs.clamped, expected.clamped);
        ASSERT_EQ(sanitise(is), is);
      }
    }
  }
}

TEST(Sanitiser, TreatsFloatsAsAPlainComparisonDoes) {
  std::mt19937 random(4);
  for (const float limit : limits) {
    const Sanitiser sanitise(limit);
    const float largest = limit > 65504.f ? limit : half_below(limit);
    for (int i = 0; i < 100000; ++i) {
      const auto bits = static_cast<std::uint32_t>(i < 4 ? 0x7f7fffffu + i : random());
      const Expected expected = sanitised(std::bit_cast<float>(bits), largest);
      Pixel<SampleType::float32> pixel{{bits, 0, 0, 0}};
      ColourRepairs repairs;
      const auto is = sanitise(pixel, repairs);
      ASSERT_EQ(is.rgba[0], std::bit_cast<std::uint32_t>(expected.value)) << std::bit_cast<float>(bits);
      ASSERT_EQ(repairs.not_finite, expected.not_finite);
      ASSERT_EQ(repairs.clamped, expected.clamped);
    }
  }
}

TEST(Sanitiser, CountsAPixelOncePerKindOfRepair) {
  const Sanitiser sanitise(10.f);
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  ColourRepairs repairs;
  sanitise(Pixel<SampleType::float32>{{bits(NAN), bits(INFINITY), bits(11.f), bits(1.f)}}, repairs);
  EXPECT_EQ(repairs.not_finite, 1);
  EXPECT_EQ(repairs.clamped, 1);
  sanitise(Pixel<SampleType::float32>{{bits(12.f), bits(-13.f), bits(10.f), bits(1.f)}}, repairs);
  EXPECT_EQ(repairs.not_finite, 1);
  EXPECT_EQ(repairs.clamped, 2);
}

TEST(Sanitiser, LeavesAnOpaqueAlphaAloneHoweverDarkTheLargestRadiance) {
  const Sanitiser sanitise(0.25f);
  ColourRepairs repairs;
  const Pixel<SampleType::half> as_half{{0, 0, 0, imath_float_to_half(1.f)}};
  const Pixel<SampleType::float32> as_float{{0, 0, 0, std::bit_cast<std::uint32_t>(1.f)}};
  EXPECT_EQ(sanitise(as_half, repairs), as_half);
  EXPECT_EQ(sanitise(as_float, repairs), as_float);
  EXPECT_EQ(repairs.clamped, 0);
}

TEST(HalfToFloat, IsExactForEveryFiniteHalf) {
  for (int bits = 0; bits < 65536; ++bits) {
    if ((bits & 0x7c00) == 0x7c00) continue;
    const auto sample = static_cast<std::uint16_t>(bits);
    ASSERT_EQ(std::bit_cast<std::uint32_t>(finite_half_to_float(sample)),
              std::bit_cast<std::uint32_t>(imath_half_to_float(sample)));
  }
}

}  // namespace
}  // namespace pullfocus
