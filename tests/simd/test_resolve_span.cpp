// Division and storing of spans, against the same pixel by pixel.
#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "resolve/resolve.h"
#include "targets.h"

namespace pullfocus {
namespace {

void resolve_plainly(const Accumulator* values, int lanes, int x, int y, const ColourImage& own, ColourImage& out) {
  const auto weight = static_cast<std::int64_t>(values[kWeightLane]);
  for (int c = 0; c < 4; ++c) {
    float value = own.get(x, y, c);
    if (weight != 0) {
      const int lane = c < 3 ? c : kAlphaLane;
      value = lane < lanes ? static_cast<float>(static_cast<double>(static_cast<std::int64_t>(values[lane])) *
                                                (1.0 / static_cast<double>(weight)))
                           : 1.f;
    }
    out.set(x, y, c, out.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
  }
}

// Sums of any magnitude up to 2^62, weights of about one unit, some of them 0.
std::vector<Accumulator> random_sums(std::mt19937_64& random, int n, int lanes, bool zeros) {
  std::vector<Accumulator> sums(static_cast<std::size_t>(n * lanes));
  for (int i = 0; i < n * lanes; ++i) {
    const auto value = static_cast<std::int64_t>(random()) >> (1 + random() % 62);
    const auto weight = static_cast<std::int64_t>((1ull << 40) + random() % (1ull << 38)) - (1ll << 37);
    const bool is_weight = i % lanes == kWeightLane;
    sums[static_cast<std::size_t>(i)] = static_cast<Accumulator>(!is_weight                   ? value
                                                                 : zeros && random() % 9 == 0 ? 0
                                                                                              : weight);
  }
  return sums;
}

TEST(ResolveSpan, EqualsPlainDivisionForAnyLengthTypeLanesAndTarget) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937_64 random(5);
    for (int n = 1; n <= 100; ++n) {
      const Window window{-3, 2, n + 2, 4};
      ColourImage own(window, SampleType::float32);
      for (int x = window.x0; x < window.x1; ++x) {
        for (int c = 0; c < 4; ++c) own.set(x, 3, c, static_cast<float>(random() % 200000) - 1e5f);
      }
      for (const SampleType type : {SampleType::half, SampleType::float32}) {
        for (const int lanes : {kOpaqueLanes, kAlphaLanes}) {
          const std::vector<Accumulator> sums = random_sums(random, n, lanes, n % 2);
          ColourImage out(window, type), expected(window, type);
          resolve_span(sums.data(), lanes, 2, 2 + n, 1, own, out);
          for (int i = 0; i < n; ++i)
            resolve_plainly(&sums[static_cast<std::size_t>(i * lanes)], lanes, i - 1, 3, own, expected);
          ASSERT_EQ(out, expected) << test::simd_target_name(target) << ", " << n << " pixels, " << lanes << " lanes";
        }
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
