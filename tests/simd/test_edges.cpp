// Groups of sources as run edges, against single edges written one lane at a time.
#include "scatter/edges.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
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
void write_plainly(const Kernel& kernel, const Emission<lanes>& source, int y, const BandImage& image, Band& band) {
  for (int row = std::max(y - kernel.radius_y, image.y0); row < std::min(y + kernel.radius_y + 1, image.y1); ++row) {
    for (const KernelEdge& edge : kernel.row(row - y)) {
      const KernelStep step = kernel.steps[edge.step];
      Accumulator* out = band.row(image.band_row(row)) + (source.x + edge.dx) * lanes;
      for (int c = 0; c < lanes; ++c) {
        const Accumulator change = contribution(source.plus[c], source.minus[c], kernel.levels[step.high]) -
                                   contribution(source.plus[c], source.minus[c], kernel.levels[step.low]);
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

template <int lanes>
void check_random_groups() {
  std::mt19937 random(4);
  KernelOptions options;
  options.max_coc_px = 44;
  const KernelTable kernels(options);
  const BandLayout layout{kWidth, kHeight, 60, lanes};
  for (int round = 0; round < 600; ++round) {
    const bool with_minus = round % 2;
    const Kernel& kernel = kernels.kernel(static_cast<int>(random() % static_cast<unsigned>(kernels.coc().size())));
    const bool flipped = random() % 2;
    const int y0 = 4, y1 = 20, y = -5 + static_cast<int>(random() % 35);
    const BandImage image{y0, y1, flipped ? y1 - 1 : y0, flipped ? -1 : 1};
    Emission<lanes> sources[kWindow];
    std::uint32_t members = 0;
    int count = 0;
    const int x = static_cast<int>(random() % (kWidth - kWindow)), span = 1 << random() % 4;
    for (int i = 0; i < span; ++i) {
      if (i > 0 && random() % 3 == 0) continue;  // a column that is no source
      Emission<lanes>& e = sources[count];
      e.x = x + i;
      random_lanes<lanes>(random, true, e.plus);
      random_lanes<lanes>(random, with_minus && random() % 2, e.minus);
      members |= std::uint32_t{count == 0 || random() % 3 != 0} << count;  // the others have other kernels
      ++count;
    }
    const int width = sources[std::bit_width(members) - 1].x - x + 1;
    Band band, expected;
    band.begin(layout, y0, y1);
    expected.begin(layout, y0, y1);
    group_writers<lanes>(with_minus).writer(width)(kernel, sources, members, x, y, image, band);
    for (int i = 0; i < count; ++i) {
      if (members >> i & 1) write_plainly<lanes>(kernel, sources[i], y, image, expected);
    }
    for (int row = y0; row < y1; ++row) {
      for (int i = -layout.pad * lanes; i < (kWidth + layout.pad) * lanes; ++i) {
        ASSERT_EQ(band.row(row)[i], expected.row(row)[i]) << "round " << round << ", width " << width;
      }
    }
  }
}

TEST(Edges, GroupsEqualSingleEdgesOnEveryTarget) {
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget on(target);
    check_random_groups<kOpaqueLanes>();
    check_random_groups<kAlphaLanes>();
    ASSERT_FALSE(HasFailure()) << "on " << test::simd_target_name(target);
  }
}

}  // namespace
}  // namespace pullfocus
