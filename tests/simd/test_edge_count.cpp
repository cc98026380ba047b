// Counting the edges of changes, against the same written pixel by pixel.
#include "importance/edge_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "scatter/state.h"
#include "targets.h"

namespace pullfocus {
namespace {

EdgeCount plain_count(const KernelTable& kernels, std::int16_t was, std::int16_t is) {
  const auto edges = [&](std::int16_t index) -> std::int64_t {
    return is_source(index) ? kernels.kernel(index).edge_count() : 0;
  };
  if (was == is) return {edges(is), 0, 0};
  const bool near = is_source(was) && is_source(is) && std::abs(is - was) <= KernelTable::kFarthestMove;
  const std::int64_t both = edges(was) + edges(is);
  return {both, near ? both : 0, edges(is) - edges(was)};
}

KernelTable small_kernels() {
  KernelOptions options;
  options.max_coc_px = 40;
  return KernelTable(options);
}

// An index of a table of `size` or none, more often than not near `around`.
std::int16_t any_index(std::mt19937& random, int size, int around) {
  const auto kind = random() % 16;
  if (kind == 0) return kNeverCommitted;
  if (kind == 1) return kHeldOut;
  const int index = kind < 8 ? around + static_cast<int>(random() % 13) - 6
                             : static_cast<int>(random() % static_cast<unsigned>(2 * size - 1)) - size + 1;
  return static_cast<std::int16_t>(std::clamp(index, 1 - size, size - 1));
}

TEST(EdgeCount, OfARowIsTheSumOfItsMaskedPixelsOnEveryTarget) {
  const KernelTable kernels = small_kernels();
  const int size = kernels.coc().size();
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
      const int n = round % 3 == 0 ? kTileWidth : 1 + static_cast<int>(random() % kTileWidth);
      std::vector<std::int16_t> was, is;  // of n pixels, so that a look beyond them shows where memory is checked
      for (int i = 0; i < n; ++i) {
        was.push_back(any_index(random, size, static_cast<int>(random() % 9)));
        is.push_back(round % 5 == 0 ? was.back() : any_index(random, size, was.back()));
      }
      std::uint64_t mask = first_pixels(n);
      if (round % 2) mask &= std::uint64_t{random()} << 32 | random();
      EdgeCount expected;
      for_each_pixel(mask, [&](int i) {
        const auto p = static_cast<std::size_t>(i);
        expected.add(plain_count(kernels, was[p], is[p]));
      });
      const EdgeCount count = edges_of_row(kernels, was.data(), is.data(), mask, n);
      ASSERT_EQ(count.written, expected.written) << test::simd_target_name(target) << ", " << n << " pixels";
      ASSERT_EQ(count.moved, expected.moved) << test::simd_target_name(target) << ", " << n << " pixels";
      ASSERT_EQ(count.committed, expected.committed) << test::simd_target_name(target) << ", " << n << " pixels";
    }
  }
}

TEST(EdgeCount, OfSourcesIsTheSumOverTheirKernels) {
  const KernelTable kernels = small_kernels();
  const int size = kernels.coc().size();
  std::mt19937 random(2);
  for (int round = 0; round < 2000; ++round) {
    const int n = round % 3 == 0 ? kTileWidth : static_cast<int>(random() % (kTileWidth + 1));
    std::vector<std::int16_t> index;  // of n pixels, as above
    std::int64_t expected = 0;
    for (int i = 0; i < n; ++i) {
      index.push_back(any_index(random, size, static_cast<int>(random() % 9)));
      if (is_source(index.back())) expected += kernels.kernel(index.back()).edge_count();
    }
    ASSERT_EQ(edges_of(kernels, index.data(), n), expected) << n << " pixels";
  }
}

}  // namespace
}  // namespace pullfocus
