// The disc against the geometry it stands for: area coverage and second moments.
#include "scatter/disc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scatter/kernel_table.h"

namespace pullfocus {
namespace {

struct Moments {
  double xx, yy;
};

Moments second_moments(const Kernel& kernel) {
  Moments m{0, 0};
  double sum = 0;
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) {
      const auto weight = static_cast<double>(kernel.weight(dx, dy));
      sum += weight;
      m.xx += weight * dx * dx;
      m.yy += weight * dy * dy;
    }
  }
  return {m.xx / sum, m.yy / sum};
}

// Per axis, of a disc of this diameter over square pixels.
double true_moment(double diameter) { return diameter * diameter / 16 + 1. / 12; }

// Share of pixel (dx, dy) inside an ellipse: 64 lines, each cut exactly.
double coverage(int dx, int dy, double diameter, double aspect) {
  constexpr int lines = 64;
  const double r = diameter / 2;
  double sum = 0;
  for (int i = 0; i < lines; ++i) {
    const double y = (dy - 0.5 + (i + 0.5) / lines) / aspect;
    const double half_chord = std::sqrt(std::max(0., r * r - y * y));
    sum += std::max(0., std::min(dx + 0.5, half_chord) - std::max(dx - 0.5, -half_chord));
  }
  return sum / lines;
}

int stated_levels(double diameter) {
  return diameter < 12 ? 16 : diameter < 16 ? 8 : diameter < 20 ? 3 : diameter < 40 ? 2 : 1;
}

// Largest difference between weight and coverage, in shares of a covered pixel.
double worst_share(const Kernel& kernel, double diameter, double aspect) {
  const auto full = static_cast<double>(kernel.levels.back());
  double worst = 0;
  for (int dy = 0; dy <= kernel.radius_y + 1; ++dy) {
    for (int dx = 0; dx <= kernel.radius_x + 1; ++dx) {
      const double share = static_cast<double>(kernel.weight(dx, dy)) / full;
      worst = std::max(worst, std::fabs(share - coverage(dx, dy, diameter, aspect)));
    }
  }
  return worst;
}

TEST(Disc, WeightsAreAreaCoverageOfADiscWithin03PixelsOfTheDiameter) {
  constexpr double of_sampling = 0.02;  // 16 x 16 points against exact areas
  for (const double aspect : {1., 0.9, 2.}) {
    for (const double d : {2.,  2.5, 3.,   4.5, 6.,    8.,   11.5, 12.,  13.75, 16., 19.5,
                           20., 24., 31.5, 32., 37.25, 39.5, 40.,  63.5, 64.,   101.}) {
      const Kernel kernel = disc_kernel(d, aspect);
      const double adjust = d < 64 ? 0.3 : 0;
      double least = 1;
      for (double a = -adjust; a <= adjust + 1e-9; a += 0.01) {
        least = std::min(least, worst_share(kernel, d + a, aspect));
      }
      EXPECT_LE(least, 0.5 / stated_levels(d) + of_sampling) << "diameter " << d << ", aspect " << aspect;
    }
  }
}

TEST(Disc, SecondMomentIsThatOfTheTrueDiscWithin1PercentFrom8PixelsOn) {
  for (double d = 8; d <= 500; d += d < 80 ? 1. / 16 : 13.0625) {
    const Moments m = second_moments(disc_kernel(d));
    EXPECT_NEAR(m.xx, true_moment(d), 0.01 * true_moment(d)) << "diameter " << d;
    EXPECT_NEAR(m.yy, true_moment(d), 0.01 * true_moment(d)) << "diameter " << d;
  }
}

// The true disc grows by 0.484 from 7.5 to 8 px.
TEST(Disc, Below8PixelsEveryHalfPixelStepAddsBlurButAtMost052SquarePixels) {
  const KernelTable table({});
  double before = second_moments(table.kernel(0)).xx;
  EXPECT_EQ(before, 0);
  for (int i = 1; table.coc().diameter(i) <= 8; ++i) {
    const double moment = second_moments(table.kernel(i)).xx;
    EXPECT_GT(moment, before) << "diameter " << table.coc().diameter(i);
    EXPECT_LE(moment - before, 0.52) << "diameter " << table.coc().diameter(i);
    before = moment;
  }
}

TEST(Disc, Below2PixelsTheSecondMomentGrowsWithTheSquareOfTheDiameter) {
  for (const double aspect : {1., 0.5, 2.}) {
    const Moments at_2 = second_moments(disc_kernel(2, aspect));
    for (double d = 0; d < 2; d += 1. / 16) {
      const Moments m = second_moments(disc_kernel(d, aspect));
      EXPECT_NEAR(m.xx, d * d / 4 * at_2.xx, 1e-9 * at_2.xx) << "diameter " << d;
      EXPECT_NEAR(m.yy, d * d / 4 * at_2.yy, 1e-9 * at_2.yy) << "diameter " << d;
    }
  }
}

TEST(Disc, OfDiameter0IsTheIdentity) {
  for (const double aspect : {1., 0.2, 3.}) {
    const Kernel kernel = disc_kernel(0, aspect);
    EXPECT_EQ(kernel.radius_x, 0);
    EXPECT_EQ(kernel.radius_y, 0);
    EXPECT_EQ(kernel.weight(0, 0), kWeightUnit);
    EXPECT_EQ(kernel.edge_count(), 2);
  }
}

// Both axes share one adjustment of the diameter. Measured: 3.4 % at aspect 0.5, 1.9 % from 0.9 on.
TEST(Disc, IsAnEllipseOfTheRightHeightWherePixelsAreNotSquare) {
  for (const double aspect : {0.5, 0.75, 0.9, 16. / 15, 4. / 3, 2., 4.}) {
    const double tolerance = aspect < 0.9 ? 0.04 : 0.02;
    for (double d = 8; d <= 80; d += 3. / 16) {
      const double vertical = d * aspect;
      if (vertical < 8) continue;
      const Moments m = second_moments(disc_kernel(d, aspect));
      EXPECT_NEAR(m.xx, true_moment(d), tolerance * true_moment(d)) << d << " px, aspect " << aspect;
      EXPECT_NEAR(m.yy, true_moment(vertical), tolerance * true_moment(vertical)) << d << " px, " << aspect;
    }
  }
}

}  // namespace
}  // namespace pullfocus
