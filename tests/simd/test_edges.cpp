// Rows and blocks of sources as run edges, against single edges written one lane at a time.
#include "scatter/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <random>
#include <vector>

#include "scatter/blocks.h"
#include "scatter/kernel_table.h"
#include "targets.h"

namespace pullfocus {
namespace {

constexpr int kWidth = 60, kHeight = 24;

Accumulator contribution(double plus, double minus, std::int64_t weight) {
  return static_cast<Accumulator>(std::llrint(plus * static_cast<double>(weight))) -
         static_cast<Accumulator>(std::llrint(minus * static_cast<double>(weight)));
}

template <int lanes>
void write_plainly(const Kernel& kernel, int x, const double* plus, const double* minus, int y, const BandImage& image,
                   Band& band) {
  for (int row = std::max(y - kernel.radius_y, image.y0); row < std::min(y + kernel.radius_y + 1, image.y1); ++row) {
    for (const KernelEdge& edge : kernel.row((row - y) * image.direction)) {
      const KernelStep step = kernel.steps[edge.step];
      Accumulator* out = band.row(image.band_row(row)) + (x + edge.dx) * lanes;
      for (int c = 0; c < lanes; ++c) {
        const Accumulator change = contribution(plus[c], minus[c], kernel.levels[step.high]) -
                                   contribution(plus[c], minus[c], kernel.levels[step.low]);
        out[c] += edge.rising ? change : -change;
      }
    }
  }
}

// Colours of any magnitude up to the largest half; the weight lane is 1, or 0 where nothing is taken back.
template <int lanes>
void random_lanes(std::mt19937& random, bool any, double* out) {
  std::uniform_real_distribution<double> exponent(-24, 16);
  for (int c = 0; c < lanes; ++c) {
    const double value = std::min(65504., std::exp2(exponent(random))) * (random() % 4 ? 1 : -1);
    out[c] = !any ? 0. : c == kWeightLane ? 1. : static_cast<double>(static_cast<float>(value));
  }
}

// Kernels in runs and alone, neighbours that alternate, columns without a source.
void random_indices(std::mt19937& random, int size, std::int16_t* index) {
  const auto any = [&] { return static_cast<std::int16_t>(static_cast<int>(random() % (2u * size - 1)) - size + 1); };
  std::int16_t last = any();
  for (int i = 0; i < kTileWidth; ++i) {
    if (random() % 12 == 0) last = any();
    index[i] = random() % 6 == 0 ? any() : last;
  }
}

// Some columns of a tile row at image column x.
template <int lanes>
void random_row(std::mt19937& random, const KernelTable& kernels, int x, SourceRow<lanes>& sources) {
  const int size = kernels.coc().size();
  sources.x = x;
  sources.mask = std::uint64_t{random()} << 32 | random();
  if (random() % 3 > 0) sources.mask |= std::uint64_t{random()} << 32 | random();
  if (random() % 3 > 0) sources.mask |= std::uint64_t{random()} << 32 | random();
  random_indices(random, size, sources.index);
  std::fill(sources.index + kTileWidth, std::end(sources.index), kNeverCommitted);
  for (int i = 0; i < kTileWidth; ++i) {
    random_lanes<lanes>(random, true, sources.plus + i * lanes);
    random_lanes<lanes>(random, random() % 2, sources.minus + i * lanes);
    const int far = KernelTable::kFarthestMove, by = static_cast<int>(random() % (2u * far + 1)) - far;
    sources.old[i] =
        static_cast<std::int16_t>(std::clamp(sources.index[i] + (random() % 3 ? 1 : by), 1 - size, size - 1));
  }
  std::fill(sources.old + kTileWidth, std::end(sources.old), kNeverCommitted);
}

template <int lanes>
void write_row_plainly(const KernelTable& kernels, const SourceRow<lanes>& sources, RowKind kind, int y,
                       const BandImage& image, Band& band) {
  for_each_pixel(sources.mask, [&](int i) {
    const double nothing[lanes] = {};
    const auto write = [&](int index, const double* plus, const double* minus) {
      write_plainly<lanes>(kernels.kernel(index), sources.x + i, plus, minus, y, image, band);
    };
    const double *const plus = sources.plus + i * lanes, *const minus = sources.minus + i * lanes;
    write(sources.index[i], plus, kind == RowKind::recoloured ? minus : nothing);
    if (kind == RowKind::moved) write(sources.old[i], nothing, minus);
  });
}

void expect_equal(Band& band, Band& expected, const BandLayout& layout, int round) {
  for (int row = band.y0(); row < band.y1(); ++row) {
    for (int i = -layout.pad * layout.lanes; i < (kWidth + layout.pad) * layout.lanes; ++i) {
      ASSERT_EQ(band.row(row)[i], expected.row(row)[i]) << "round " << round;
    }
  }
}

constexpr int kBandBegin = 4, kBandEnd = 20;
BandImage random_image(std::mt19937& random) {
  const bool flipped = random() % 2;
  return {kBandBegin, kBandEnd, flipped ? kBandEnd - 1 : kBandBegin, flipped ? -1 : 1};
}

template <int lanes>
void check_random_rows(const KernelTable& kernels) {
  std::mt19937 random(4);
  const BandLayout layout{kWidth, kHeight, 100, lanes};
  for (int round = 0; round < 60; ++round) {
    const auto kind = static_cast<RowKind>(round % 3);
    const int y = -5 + static_cast<int>(random() % 35);
    const BandImage image = random_image(random);
    SourceRow<lanes> sources;
    random_row<lanes>(random, kernels, -static_cast<int>(random() % 5), sources);
    Band band, expected;
    band.begin(layout, kBandBegin, kBandEnd);
    expected.begin(layout, kBandBegin, kBandEnd);
    row_writer<lanes>(kind)(kernels, sources, y, image, band);
    write_row_plainly<lanes>(kernels, sources, kind, y, image, expected);
    ASSERT_NO_FATAL_FAILURE(expect_equal(band, expected, layout, round));
  }
}

// Has plans of blocks made.
void ask_for_blocks(const KernelTable& kernels, int times) {
  const int size = kernels.coc().size();
  for (int index = 1 - size; index < size; ++index) {
    for (int i = 0; i < times; ++i) {
      kernels.block(index);
      for (int by = -1; by <= 1; ++by) {
        if (std::abs(index + by) < size) kernels.block_move(index, index + by);
      }
    }
  }
}

// Rows of a block that are mostly alike; returns how many sources were written as blocks.
template <int lanes>
int check_random_blocks(const KernelTable& kernels) {
  std::mt19937 random(5);
  const BandLayout layout{kWidth, kHeight, 100, lanes};
  BlockValues values;
  int in_blocks = 0;
  for (int round = 0; round < 60; ++round) {
    const auto kind = static_cast<RowKind>(round % 3);
    SourceBlock<lanes> block;
    block.x = -static_cast<int>(random() % 5);
    block.y = -5 + static_cast<int>(random() % 35);
    const BandImage image = random_image(random);
    std::vector<SourceRow<lanes>> rows(kBlockRows);
    for (std::size_t h = 0; h < kBlockRows; ++h) {
      random_row<lanes>(random, kernels, block.x, rows[h]);
      if (random() % 8 == 0) rows[h].mask = 0;
      for (int i = 0; i < kTileWidth && h > 0; ++i) {
        if (random() % 12 == 0) continue;
        rows[h].index[i] = rows[0].index[i];
        rows[h].old[i] = rows[0].old[i];
      }
      block.rows[h] = &rows[h];
      block.masks[h] = rows[h].mask;
    }
    Band band, expected;
    band.begin(layout, kBandBegin, kBandEnd);
    expected.begin(layout, kBandBegin, kBandEnd);
    for (std::size_t h = 0; h < kBlockRows; ++h) {
      write_row_plainly<lanes>(kernels, rows[h], kind, block.y + static_cast<int>(h), image, expected);
    }
    block_writer<lanes>(kind)(kernels, block, image, band, values);
    for (std::size_t h = 0; h < kBlockRows; ++h) {
      EXPECT_EQ(block.masks[h] & ~rows[h].mask, 0u);
      in_blocks += std::popcount(rows[h].mask & ~block.masks[h]);
      rows[h].mask = block.masks[h];
      row_writer<lanes>(kind)(kernels, rows[h], block.y + static_cast<int>(h), image, band);
    }
    expect_equal(band, expected, layout, round);
    if (testing::Test::HasFatalFailure()) return 0;
  }
  return in_blocks;
}

// A disc's rims have up to 16 levels, a polygon's rows are no mirror images, a gaussian rises step after step.
class Edges : public testing::TestWithParam<KernelShape::Kind> {
 protected:
  static KernelTable kernels(float largest) {
    KernelOptions options;
    options.shape.kind = GetParam();
    options.shape.blades = 5;
    options.max_coc_px = largest;
    return KernelTable(options);
  }
};

TEST_P(Edges, RowsEqualSingleEdgesOnEveryTarget) {
  const KernelTable table = kernels(44);
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    check_random_rows<kOpaqueLanes>(table);
    check_random_rows<kAlphaLanes>(table);
    ASSERT_FALSE(HasFailure()) << "on " << test::simd_target_name(target);
  }
}

TEST_P(Edges, BlocksEqualSingleEdgesOnEveryTarget) {
  for (const int asked : {KernelTable::kAskedForBlock, KernelTable::kAskedForSums}) {
    const KernelTable table = kernels(90);
    ask_for_blocks(table, asked);
    for (const std::int64_t target : test::simd_targets()) {
      const test::OnTarget on(target);
      const int opaque = check_random_blocks<kOpaqueLanes>(table), alpha = check_random_blocks<kAlphaLanes>(table);
      ASSERT_FALSE(HasFailure()) << "on " << test::simd_target_name(target);
      EXPECT_GT(std::min(opaque, alpha), 1000) << "on " << test::simd_target_name(target);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Edges,
                         testing::Values(KernelShape::Kind::disc, KernelShape::Kind::polygon,
                                         KernelShape::Kind::gaussian));

}  // namespace
}  // namespace pullfocus
