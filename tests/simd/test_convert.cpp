// The conversions that every target must round alike, against the plain ones.
#include <Imath/half.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/test_convert.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/convert-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

template <std::size_t most>
void RoundWith(const double* in, std::size_t n, std::int64_t* out) {
  const hn::CappedTag<double, most> d;
  const hn::RebindToSigned<decltype(d)> di;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) hn::StoreU(RoundToInt64(d, hn::LoadU(d, in + i)), di, out + i);
}

std::int64_t Target() { return HWY_TARGET; }

// With vectors of at most `most` lanes; n a multiple of 8.
void Round(const double* in, std::size_t n, int most, std::int64_t* out) {
  if (most == 1) RoundWith<1>(in, n, out);
  if (most == 2) RoundWith<2>(in, n, out);
  if (most == 4) RoundWith<4>(in, n, out);
  if (most == 8) RoundWith<8>(in, n, out);
}

// n a multiple of 16.
void Halves(const float* in, std::size_t n, std::uint16_t* out) {
  const hn::CappedTag<float, 16> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) hn::StoreU(HalfFromFloat(d, hn::LoadU(d, in + i)), d16, out + i);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {
namespace {

HWY_EXPORT(Target);
HWY_EXPORT(Round);
HWY_EXPORT(Halves);

std::vector<double> doubles_below_2_to_61() {
  std::mt19937_64 random(7);
  std::vector<double> values{0., -0., 0.5, -0.5, 1.5, -1.5, 2.5, -2.5, 0x1.fffffffffffffp-2, -0x1.fffffffffffffp-2};
  // Ties and their neighbours around every power of two, where a split value carries from one half to the other.
  for (int exponent = -3; exponent <= 61; ++exponent) {
    for (const double offset : {0., 0.5, 1., 1.5, 0x1p31, 0x1p32, 0x1p31 + 0.5, 0x1p31 - 0.5, -0.5, -1.5, -0x1p31}) {
      const double v = std::ldexp(1, exponent) + offset;
      for (const double w : {v, std::nextafter(v, 1e30), std::nextafter(v, -1e30)}) {
        values.push_back(w), values.push_back(-w);
      }
    }
  }
  for (int i = 0; i < 400000; ++i) {
    const std::uint64_t mantissa = random() & 0x800fffffffffffffu;
    values.push_back(std::bit_cast<double>(mantissa | (1023 - 4 + random() % 65) << 52));
    // Halves of odd integers: ties wherever the mantissa reaches that far down.
    values.push_back(static_cast<double>(static_cast<std::int64_t>(random()) >> (11 + random() % 50)) / 2);
  }
  while (values.size() % 8 != 0) values.push_back(0);
  return values;
}

TEST(Targets, AForcedTargetIsTheOneThatRunsAndAllCompiledOnesThatTheProcessorHasAreForced) {
  std::int64_t seen = 0;
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    EXPECT_EQ(HWY_DYNAMIC_DISPATCH(Target)(), target) << test::simd_target_name(target);
    seen |= target;
  }
  EXPECT_NE(seen & HWY_STATIC_TARGET, 0) << "the target that every processor has";
  EXPECT_EQ(HWY_DYNAMIC_DISPATCH(Target)(), seen & -seen) << "the best one comes back";
}

TEST(Convert, RoundingToIntegersEqualsLlrintOnEveryTargetAndVectorLength) {
  const std::vector<double> values = doubles_below_2_to_61();
  std::vector<std::int64_t> rounded(values.size());
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    for (const int most : {1, 2, 4, 8}) {
      std::fill(rounded.begin(), rounded.end(), -1);
      HWY_DYNAMIC_DISPATCH(Round)(values.data(), values.size(), most, rounded.data());
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(rounded[i], std::llrint(values[i])) << test::simd_target_name(target) << ", " << values[i];
      }
    }
  }
}

// Every half, what lies halfway to the next one, the floats next to these, and random floats; within +-65504.
std::vector<float> floats_around_halves() {
  std::vector<float> values;
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    if ((bits & 0x7c00u) == 0x7c00u) continue;
    const float half = imath_half_to_float(static_cast<std::uint16_t>(bits));
    values.push_back(half);
    if ((bits & 0x7fffu) == 0x7bffu) continue;
    const float middle = (half + imath_half_to_float(static_cast<std::uint16_t>(bits + 1))) / 2;
    for (const float v : {middle, std::nextafter(middle, 1e9f), std::nextafter(middle, -1e9f),
                          std::nextafter(half, 1e9f), std::nextafter(half, -1e9f)}) {
      if (std::fabs(v) <= 65504.f) values.push_back(v);
    }
  }
  std::mt19937 random(9);
  for (int i = 0; i < 1000000; ++i) {
    const float v = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::fabs(v) <= 65504.f) values.push_back(v);
  }
  while (values.size() % 16 != 0) values.push_back(0);
  return values;
}

TEST(Convert, HalvesEqualImathsOnEveryTarget) {
  const std::vector<float> values = floats_around_halves();
  std::vector<std::uint16_t> halves(values.size());
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::fill(halves.begin(), halves.end(), std::uint16_t{0xffff});
    HWY_DYNAMIC_DISPATCH(Halves)(values.data(), values.size(), halves.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(halves[i], imath_float_to_half(values[i])) << test::simd_target_name(target) << ", " << values[i];
    }
  }
}

}  // namespace
}  // namespace pullfocus
#endif
