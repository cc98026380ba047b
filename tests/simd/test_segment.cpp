// Reading segments of rows, against the same written pixel by pixel.
#include "importance/segment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "scatter/state.h"
#include "targets.h"

namespace pullfocus {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
constexpr SampleType types[] = {SampleType::half, SampleType::float32};

// Calls check() on every target; a failure names it.
template <typename Check>
void on_every_target(Check&& check) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    check();
    ASSERT_FALSE(testing::Test::HasFailure()) << "on " << test::simd_target_name(target);
  }
}

float random_depth(std::mt19937& random, bool hostile) {
  constexpr float odd[] = {nan, infinity, -infinity, 0.f, -0.f, -3.f, 1e9f, 1e10f, 1e-42f, -1e-42f, 3e38f, 1e-3f};
  if (hostile && random() % 8 == 0) return odd[random() % 12];
  if (hostile && random() % 8 == 0) return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  return std::uniform_real_distribution<float>(0.05f, 30)(random);
}

std::int16_t plain_index(const CocFunction& coc, const CocTable& table, float depth, int& clamped) {
  const float c = is_background(coc.kind, depth) ? coc.background() : coc(depth);
  clamped += std::fabs(c) > table.max_diameter();
  return table.index(c);
}

CocFunction random_coc(std::mt19937& random) {
  std::uniform_real_distribution<float> uniform(0, 1);
  CocFunction coc;
  coc.kind = random() % 3 == 0 ? DepthKind::coc : DepthKind::planar;
  coc.scale = random() % 8 == 0 ? 3e38f : 200 * uniform(random);
  coc.inverse_focus = random() % 4 == 0 ? 0.f : uniform(random);
  const float factors[] = {1.f, 0.f, 3 * uniform(random), 1e30f, 1e-42f};
  if (random() % 2) coc.artistic = {factors[random() % 5], factors[random() % 5]};
  return coc;
}

TEST(Segment, SignedIndicesEqualThePlainOnesForAnyDepthLensTableAndLength) {
  on_every_target([] {
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round) {
      const CocTable table(round % 2 ? 1. / 32 : 0., 1 + static_cast<double>(random() % 499));
      const CocFunction coc = random_coc(random);
      const int n = round % 3 == 0 ? kTileWidth : 1 + static_cast<int>(random() % kTileWidth);
      float depth[kTileWidth];
      SegmentFindings expected;
      std::int16_t index[kTileWidth], expected_index[kTileWidth];
      const bool hostile = random() % 2;
      bool may_be_suspect = false;
      for (int i = 0; i < n; ++i) {
        depth[i] = random_depth(random, hostile);
        if (coc.kind == DepthKind::coc && random() % 2) depth[i] = -depth[i];
        expected_index[i] = plain_index(coc, table, depth[i], expected.clamped);
        expected.largest = std::max(expected.largest, std::abs(static_cast<int>(expected_index[i])));
        may_be_suspect |= is_suspect(coc.kind, depth[i], true);
      }
      std::fill_n(index, kTileWidth, std::int16_t{-7});
      const SegmentFindings found = signed_indices(DepthToIndex(coc, table), depth, n, index);
      for (int i = 0; i < n; ++i) ASSERT_EQ(index[i], expected_index[i]) << "depth " << depth[i];
      for (int i = n; i < kTileWidth; ++i) ASSERT_EQ(index[i], -7) << "written past the end";
      ASSERT_EQ(found.clamped, expected.clamped);
      ASSERT_EQ(found.largest, expected.largest);
      ASSERT_EQ(found.suspect, may_be_suspect);
    }
  });
}

TEST(Segment, ADifferenceInAnyBitOfAnyPixelIsSeenAndNoOther) {
  on_every_target([] {
    std::mt19937 random(2);
    const CocTable table(1. / 32, 60);
    for (const SampleType sample : types) {
      dispatch(sample, [&]<SampleType type>() {
        for (int round = 0; round < 3000; ++round) {
          const CocFunction coc = random_coc(random);
          const int n = 1 + static_cast<int>(random() % kTileWidth);
          float depth[kTileWidth];
          Pixel<type> colours[kTileWidth], old[kTileWidth];
          std::int16_t old_index[kTileWidth], index[kTileWidth];
          for (int i = 0; i < n; ++i) {
            depth[i] = random_depth(random, round % 2);
            for (auto& bits : colours[i].rgba) bits = static_cast<std::uint16_t>(random());
            old[i] = colours[i];
          }
          signed_indices(DepthToIndex(coc, table), depth, n, old_index);
          std::uint64_t moved = 0, recoloured = 0;
          for (int k = round % 5; k > 0; --k) {
            const auto i = static_cast<int>(random()) & 63, c = static_cast<int>(random()) & 3;
            if (i >= n) continue;
            const auto bit = random() % (8 * sizeof old[i].rgba[c]);
            using Bits = std::remove_reference_t<decltype(old[i].rgba[c])>;
            old[i].rgba[c] = static_cast<Bits>(old[i].rgba[c] ^ (Bits{1} << bit));
            if (random() % 2)
              old_index[i] = random() % 2 ? kNeverCommitted : static_cast<std::int16_t>(old_index[i] + 1);
          }
          std::int16_t expected[kTileWidth];
          signed_indices(DepthToIndex(coc, table), depth, n, expected);
          for (int i = 0; i < n; ++i) {
            moved |= std::uint64_t{expected[i] != old_index[i]} << i;
            recoloured |= std::uint64_t{!(colours[i] == old[i])} << i;
          }
          SegmentDifference difference;
          compare<type>(DepthToIndex(coc, table), {depth, colours, old, old_index, n}, index, difference);
          ASSERT_EQ(difference.index, moved) << n;
          ASSERT_EQ(difference.colour, recoloured) << n;
          ASSERT_TRUE(std::equal(index, index + n, expected));
          ASSERT_FALSE(difference.known);
        }
      });
    }
  });
}

TEST(Segment, KnownDepthsAreThoseOfEqualBits) {
  on_every_target([] {
    std::mt19937 random(4);
    const CocTable table(1. / 32, 60);
    constexpr auto type = SampleType::half;
    for (int round = 0; round < 3000; ++round) {
      const CocFunction coc = random_coc(random);
      const int n = 1 + static_cast<int>(random() % kTileWidth);
      float depth[kTileWidth], known[kTileWidth];
      Pixel<type> colours[kTileWidth] = {}, old[kTileWidth] = {};
      std::int16_t old_index[kTileWidth], index[kTileWidth], expected[kTileWidth];
      for (int i = 0; i < n; ++i) known[i] = depth[i] = random_depth(random, round % 2);
      signed_indices(DepthToIndex(coc, table), known, n, old_index);
      const int recoloured = static_cast<int>(random()) & 63;
      old[recoloured].rgba[random() % 4] ^= 1;
      const bool moved = random() % 2;
      if (moved) {
        float& one = depth[random() % static_cast<unsigned>(n)];
        one = std::bit_cast<float>(std::bit_cast<std::uint32_t>(one) ^ (1u << random() % 32));  // 0 to -0, too
      }
      std::fill_n(index, kTileWidth, std::int16_t{-7});
      const SegmentFindings expected_findings = signed_indices(DepthToIndex(coc, table), depth, n, expected);
      SegmentDifference difference;
      const SegmentFindings found =
          compare<type>(DepthToIndex(coc, table), {depth, colours, old, old_index, n, known}, index, difference);
      ASSERT_EQ(difference.known, !moved);
      ASSERT_EQ(difference.colour, recoloured < n ? std::uint64_t{1} << recoloured : 0);
      if (!moved) {
        ASSERT_EQ(difference.index, 0u);
        ASSERT_EQ(std::count(index, index + kTileWidth, -7), kTileWidth) << "nothing to write";
        continue;
      }
      ASSERT_TRUE(std::equal(index, index + n, expected));
      ASSERT_EQ(found.clamped, expected_findings.clamped);
      std::uint64_t differ = 0;
      for (int i = 0; i < n; ++i) differ |= std::uint64_t{expected[i] != old_index[i]} << i;
      ASSERT_EQ(difference.index, differ);
    }
  });
}

TEST(Segment, UnchangedOnesEndBeforeTheFirstBitThatDiffers) {
  on_every_target([] {
    std::mt19937 random(5);
    for (const SampleType sample : types) {
      dispatch(sample, [&]<SampleType type>() {
        for (int round = 0; round < 2000; ++round) {
          const int count = 1 + round % 5;
          const auto pixels = static_cast<std::size_t>(count * kTileWidth);
          std::vector<float> depth(pixels), known(pixels);
          std::vector<Pixel<type>> colours(pixels), old(pixels);
          for (std::size_t i = 0; i < pixels; ++i) {
            known[i] = depth[i] = random_depth(random, true);
            for (auto& bits : colours[i].rgba) bits = static_cast<std::uint16_t>(random());
            old[i] = colours[i];
          }
          std::size_t first = pixels;
          for (int k = round % 4; k > 0; --k) {
            const std::size_t i = random() % pixels;
            auto& sample_of = old[i].rgba[random() % 4];
            using Bits = std::remove_reference_t<decltype(sample_of)>;
            if (random() % 2) {
              sample_of = static_cast<Bits>(sample_of ^ (Bits{1} << random() % (8 * sizeof sample_of)));
            } else {
              known[i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(known[i]) ^ (1u << random() % 32));
            }
            const bool differs = !(old[i] == colours[i]) || std::memcmp(&known[i], &depth[i], sizeof depth[i]) != 0;
            if (differs) first = std::min(first, i);
          }
          const SegmentPair<type> pair{depth.data(), colours.data(), old.data(), nullptr, kTileWidth, known.data()};
          ASSERT_EQ(unchanged_segments<type>(pair, count), static_cast<int>(first / kTileWidth));
        }
      });
    }
  });
}

TEST(Segment, WhatIsSaneTheSanitiserLeavesAndNothingElseIs) {
  on_every_target([] {
    std::mt19937 random(3);
    for (const float limit : {65504.f, 100.03f, 1.f}) {
      const Sanitiser sanitiser(limit);
      for (const SampleType sample : types) {
        dispatch(sample, [&]<SampleType type>() {
          for (int round = 0; round < 4000; ++round) {
            const int n = 1 + static_cast<int>(random() % kTileWidth);
            Pixel<type> pixels[kTileWidth];
            for (int i = 0; i < n; ++i) {
              for (auto& bits : pixels[i].rgba) bits = static_cast<std::uint16_t>(random() % 0x3c01);  // at most 1
            }
            auto& odd = pixels[random() % static_cast<unsigned>(n)].rgba[random() % 4];
            using Bits = std::remove_reference_t<decltype(odd)>;
            if (round % 2) odd = static_cast<Bits>(random());
            if (round % 16 == 1) odd = sanitiser.limit<type>();
            if (round % 16 == 3) odd = static_cast<Bits>(sanitiser.limit<type>() + 1);
            bool sane = true;
            for (int i = 0; i < n; ++i) sane &= sanitiser(pixels[i]) == pixels[i];
            ASSERT_EQ(all_sane<type>(sanitiser, pixels, n), sane) << n << " pixels, limit " << limit;
          }
        });
      }
    }
  });
}

}  // namespace
}  // namespace pullfocus
