// Layers laid over each other, against the same pixel by pixel.
#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "resolve/compose.h"
#include "resolve/resolve.h"
#include "targets.h"

namespace pullfocus {
namespace {

constexpr auto kUnit = static_cast<double>(kCoveringWeight);
using Layers = std::span<const Accumulator* const>;
using Colour = std::array<float, 4>;

double at(const Accumulator* layer, int i) { return static_cast<double>(static_cast<std::int64_t>(layer[i])); }

// Of a pixel whose sums begin at index `first` of every layer.
struct Plain {
  Colour colour;
  double free;  // of a unit
  bool has_weight;
};

Plain compose_plainly(Layers layers, int lanes, int first) {
  double free = kUnit;
  std::vector<double> taken(layers.size());
  std::size_t farthest = 0;
  int reached = 0;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const double weight = at(layers[l], first + kWeightLane);
    taken[l] = std::min(weight, free);
    free -= taken[l];
    if (weight == 0) continue;
    farthest = l;
    ++reached;
  }
  if (reached > 0) taken[farthest] += free;
  std::array<double, 4> sum{};
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const double weight = at(layers[l], first + kWeightLane);
    if (weight == 0) continue;
    const double share = (reached == 1 ? 1 : taken[l] * (1 / kUnit)) / weight;
    for (int c = 0; c < 4; ++c) {
      const int lane = c < 3 ? c : kAlphaLane;
      if (lane < lanes) sum[static_cast<std::size_t>(c)] += at(layers[l], first + lane) * share;
    }
  }
  Plain plain{{}, free * (1 / kUnit), reached > 0};
  for (std::size_t c = 0; c < 4; ++c) plain.colour[c] = static_cast<float>(sum[c]);
  if (lanes == kOpaqueLanes) plain.colour[3] = 1;
  return plain;
}

// Sums of n pixels: a third without weight, and so without colour, others of up to two units, some of them at what the
// rules compare with or just below.
std::vector<Accumulator> random_layer(std::mt19937_64& random, int n, int lanes) {
  constexpr std::int64_t eighths[] = {1, 7, 8};
  std::vector<Accumulator> layer;
  for (int i = 0; i < n; ++i) {
    std::int64_t weight = 0;
    if (random() % 3 != 0) weight = static_cast<std::int64_t>(random() % (2 * kWeightUnit));
    if (random() % 8 == 0)
      weight = kCoveringWeight / 8 * eighths[random() % 3] - static_cast<std::int64_t>(random() % 2);
    for (int lane = 0; lane < lanes; ++lane) {
      const auto value = static_cast<std::int64_t>(random()) >> (1 + random() % 62);
      layer.push_back(static_cast<Accumulator>(lane == kWeightLane ? weight : weight == 0 ? 0 : value));
    }
  }
  return layer;
}

void expect_chunk(Layers layers, std::size_t near, int lanes, int n, const Backdrop::Chunk& chunk) {
  for (int i = 0; i < n; ++i) {
    const int first = i * lanes;
    double in_front = 0, behind = 0;
    for (std::size_t l = 0; l < layers.size(); ++l)
      (l < near ? in_front : behind) += at(layers[l], first + kWeightLane);
    const Plain all = compose_plainly(layers, lanes, first);
    const bool hole = in_front > 0 && behind == 0 && all.free > Backdrop::kLeastFree;
    const bool shows = in_front > 0 && behind >= Backdrop::kEnoughBehind * kUnit;
    ASSERT_EQ(chunk.holes >> i & 1, hole) << i;
    ASSERT_EQ(chunk.shows >> i & 1, shows) << i;
    ASSERT_EQ(chunk.amount[i], static_cast<float>(std::min(all.free, 2 * (all.free - Backdrop::kLeastFree)))) << i;
    if (!hole && !shows) continue;
    const Colour expected = hole ? all.colour : compose_plainly(layers.subspan(near), lanes, first).colour;
    for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(chunk.colour[i][c], expected[c]) << i;
  }
  for (int i = n; i < Backdrop::kChunk; ++i) ASSERT_EQ((chunk.holes | chunk.shows) >> i & 1, 0u);
}

void expect_plain(std::mt19937_64& random, int n, SampleType type, int lanes) {
  const std::size_t count = 1 + random() % 5, near = random() % (count + 1);
  std::vector<std::vector<Accumulator>> sums;
  std::vector<const Accumulator*> layers;
  for (std::size_t l = 0; l < count; ++l) sums.push_back(random_layer(random, n, lanes));
  for (const auto& layer : sums) layers.push_back(layer.data());

  ColourImage out({0, 0, n, 1}, type), expected({0, 0, n, 1}, type);
  bool all = true;
  for (int i = 0; i < n; ++i) {
    const Plain plain = compose_plainly(layers, lanes, i * lanes);
    all &= plain.has_weight;
    for (int c = 0; c < 4; ++c) {
      const float value = plain.colour[static_cast<std::size_t>(c)];
      expected.set(i, 0, c, type == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
    }
  }
  Backdrop::Chunk chunk;
  ASSERT_EQ(compose(layers, near, lanes, n, type, out.pixel(0, 0), near > 0 ? &chunk : nullptr), all);
  ASSERT_EQ(out, expected);
  if (near > 0) expect_chunk(layers, near, lanes, n, chunk);
}

TEST(Compose, EqualsPlainArithmeticForAnyLengthTypeLanesAndTarget) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937_64 random(6);
    for (int n = 1; n <= Backdrop::kChunk; ++n) {
      for (const SampleType type : {SampleType::half, SampleType::float32}) {
        for (const int lanes : {kOpaqueLanes, kAlphaLanes}) {
          for (int repeat = 0; repeat < 4; ++repeat) {
            SCOPED_TRACE(test::simd_target_name(target) + ", " + std::to_string(n) + " pixels, " +
                         std::to_string(lanes) + " lanes");
            expect_plain(random, n, type, lanes);
            if (HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
