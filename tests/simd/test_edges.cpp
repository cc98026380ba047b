// Rows of sources as run edges, against single edges written one lane at a time.
#include "scatter/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

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

template <int lanes>
void check_random_rows(const KernelOptions& options) {
  std::mt19937 random(4);
  const KernelTable kernels(options);
  const int size = kernels.coc().size();
  const BandLayout layout{kWidth, kHeight, 100, lanes};
  for (int round = 0; round < 60; ++round) {
    const auto kind = static_cast<RowKind>(round % 3);
    const bool flipped = random() % 2;
    const int y0 = 4, y1 = 20, y = -5 + static_cast<int>(random() % 35);
    const BandImage image{y0, y1, flipped ? y1 - 1 : y0, flipped ? -1 : 1};
    SourceRow<lanes> sources;
    sources.x = -static_cast<int>(random() % 5);
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
    Band band, expected;
    band.begin(layout, y0, y1);
    expected.begin(layout, y0, y1);
    row_writer<lanes>(kind)(kernels, sources, y, image, band);
    for_each_pixel(sources.mask, [&](int i) {
      const double nothing[lanes] = {};
      const auto write = [&](int index, const double* plus, const double* minus) {
        write_plainly<lanes>(kernels.kernel(index), sources.x + i, plus, minus, y, image, expected);
      };
      const double *const plus = sources.plus + i * lanes, *const minus = sources.minus + i * lanes;
      write(sources.index[i], plus, kind == RowKind::recoloured ? minus : nothing);
      if (kind == RowKind::moved) write(sources.old[i], nothing, minus);
    });
    for (int row = y0; row < y1; ++row) {
      for (int i = -layout.pad * lanes; i < (kWidth + layout.pad) * lanes; ++i) {
        ASSERT_EQ(band.row(row)[i], expected.row(row)[i]) << "round " << round;
      }
    }
  }
}

// A disc's rims have up to 16 levels, a polygon's rows are no mirror images, a gaussian rises step after step.
TEST(Edges, RowsEqualSingleEdgesOnEveryTarget) {
  KernelOptions disc, polygon, gaussian;
  polygon.shape.kind = KernelShape::Kind::polygon;
  polygon.shape.blades = 5;
  gaussian.shape.kind = KernelShape::Kind::gaussian;
  for (KernelOptions* options : {&disc, &polygon, &gaussian}) {
    options->max_coc_px = 44;
    for (const std::int64_t target : test::simd_targets()) {
      const test::OnTarget on(target);
      check_random_rows<kOpaqueLanes>(*options);
      check_random_rows<kAlphaLanes>(*options);
      ASSERT_FALSE(HasFailure()) << "on " << test::simd_target_name(target);
    }
  }
}

}  // namespace
}  // namespace pullfocus
