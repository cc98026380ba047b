// The polygon against geometry: its moments, its symmetries, its coverage, its limits.
#include "scatter/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "scatter/disc.h"
#include "shapes.h"

namespace pullfocus {
namespace {

using std::numbers::pi;
using test::moments_of;
using test::polygon;

// Per axis, of a regular polygon with its corners on a circle, over square pixels.
double polygon_moment(double diameter, int blades) {
  return diameter * diameter / 4 * (2 + std::cos(2 * pi / blades)) / 12 + 1. / 12;
}

TEST(Polygon, SecondMomentsAreThoseOfTheInscribedPolygon) {
  for (int blades = 3; blades <= 16; ++blades) {
    for (const double rotation : {0., 13.}) {
      for (double d = 4; d <= 500; d += d < 80 ? 5. / 16 : 17.0625) {
        const test::Moments m = moments_of(polygon_kernel(d, 1, polygon(blades, rotation)));
        const double expected = polygon_moment(d, blades), tolerance = d < 8 ? 0.1 : d < 32 ? 0.045 : 0.02;
        ASSERT_NEAR(m.xx, expected, tolerance * expected)
            << blades << " blades, " << rotation << " deg, " << d << " px";
        ASSERT_NEAR(m.yy, expected, tolerance * expected)
            << blades << " blades, " << rotation << " deg, " << d << " px";
      }
    }
  }
}

// By points: inside if on the inner side of every edge between corners on the circle, the first corner up.
double coverage(int dx, int dy, double d, int blades, double rotation) {
  std::vector<std::pair<double, double>> corners;
  for (int c = 0; c <= blades; ++c) {  // anticlockwise from up, y down
    const double a = rotation * pi / 180 + 2 * pi * c / blades;
    corners.push_back({-std::sin(a) * d / 2, -std::cos(a) * d / 2});
  }
  constexpr int n = 32;
  int inside = 0;
  for (int i = 0; i < n * n; ++i) {
    const double x = dx - 0.5 + (i % n + 0.5) / n, y = dy - 0.5 + (i / n + 0.5) / n;
    bool in = true;
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
      const auto [ax, ay] = corners[k];
      const auto [bx, by] = corners[k + 1];
      in &= (bx - ax) * (y - ay) - (by - ay) * (x - ax) <= 0;
    }
    inside += in;
  }
  return static_cast<double>(inside) / (n * n);
}

TEST(Polygon, WeightsAreAreaCoverageWithACornerUp) {
  for (const int blades : {3, 5, 6, 8}) {
    for (const double rotation : {0., 20.}) {
      for (const double d : {4., 9.5, 14., 24., 40., 100., 170.}) {
        const int levels = d < 12 ? 16 : d < 16 ? 8 : d < 64 ? 4 : d < 160 ? 2 : 1;
        const Kernel kernel = polygon_kernel(d, 1, polygon(blades, rotation));
        const auto full = static_cast<double>(kernel.weight(0, 0));
        const int r = static_cast<int>(d / 2) + 2, stride = d < 50 ? 1 : 3;
        double worst = 0;
        for (int dy = -r; dy <= r; dy += stride) {
          for (int dx = -r; dx <= r; dx += stride) {
            const double is = static_cast<double>(kernel.weight(dx, dy)) / full;
            worst = std::max(worst, std::fabs(is - coverage(dx, dy, d, blades, rotation)));
          }
        }
        // Levels carry the mean of their pixels, so the whole step may be off at worst; and 16 sub-rows sample slopes.
        EXPECT_LE(worst, 1. / levels * (levels == 1 ? 0.55 : 1) + 0.03)
            << blades << " blades, " << rotation << " deg, " << d << " px";
      }
    }
  }
}

TEST(Polygon, AFullTurnAndATurnByOneBladeAreNoTurn) {
  for (int blades = 3; blades <= 16; ++blades) {
    for (const double d : {5., 33.}) {
      for (const double rotation : {0., 11.25}) {
        const Kernel kernel = polygon_kernel(d, 1, polygon(blades, rotation, 0.2));
        for (const double turn : {360., -720., 360. / blades, -360. / blades}) {
          EXPECT_TRUE(test::equal(kernel, polygon_kernel(d, 1, polygon(blades, rotation + turn, 0.2))))
              << blades << " " << turn;
        }
      }
    }
  }
}

TEST(Polygon, RotationIsAnticlockwiseInThePicture) {
  // The corner of a triangle moves from straight up to the left.
  const Kernel up = polygon_kernel(60, 1, polygon(3)), left = polygon_kernel(60, 1, polygon(3, 30));
  EXPECT_GT(up.weight(0, -28), 0);
  EXPECT_EQ(up.weight(-14, -24), 0);
  EXPECT_GT(left.weight(-14, -24), 0);
  EXPECT_EQ(left.weight(0, -28), 0);
}

TEST(Polygon, EvenOnesAreTheirOwnReflectionAndOddOnesAreNot) {
  for (int blades = 3; blades <= 16; ++blades) {
    for (const double rotation : {0., 7.5}) {
      const Kernel kernel = polygon_kernel(40, 1, polygon(blades, rotation));
      EXPECT_EQ(mirrors_of(kernel).point, blades % 2 == 0) << blades;
      if (rotation == 0) {
        EXPECT_TRUE(mirrors_of(kernel).x) << blades;
      }
      EXPECT_TRUE(test::equal(reflected(reflected(kernel)), kernel));
    }
  }
}

TEST(Polygon, OfRoundness1IsTheDisc) {
  for (const int blades : {3, 5, 8}) {
    for (double d = 8; d <= 500; d += d < 80 ? 3. / 16 : 13.0625) {
      const test::Moments m = moments_of(polygon_kernel(d, 1, polygon(blades, 10, 1)));
      const double disc = moments_of(disc_kernel(d)).xx, tolerance = d < 12 ? 0.02 : 0.01;
      EXPECT_NEAR(m.xx, disc, tolerance * disc) << d;
      EXPECT_NEAR(m.yy, disc, tolerance * disc) << d;
    }
  }
}

TEST(Polygon, GrowsWithItsRoundness) {
  double before = 0;
  for (const double roundness : {0., 1e-7, 1e-4, 0.1, 0.25, 0.5, 0.75, 0.9, 1.}) {
    const test::Moments m = moments_of(polygon_kernel(90, 1, polygon(4, 9, roundness)));
    EXPECT_GE(m.xx + m.yy, before * 0.9999) << roundness;
    before = m.xx + m.yy;
  }
}

TEST(Polygon, IsStretchedWherePixelsAreNotSquare) {
  for (const double aspect : {0.5, 0.8, 1.25, 2.}) {
    for (double d = 40; d <= 60; d += 0.5) {
      const test::Moments m = moments_of(polygon_kernel(d, aspect, polygon(5, 3)));
      EXPECT_NEAR(m.xx, polygon_moment(d, 5), 0.03 * polygon_moment(d, 5));
      EXPECT_NEAR(m.yy, polygon_moment(d * aspect, 5), 0.03 * polygon_moment(d * aspect, 5));
    }
  }
}

TEST(Polygon, CostsWhatIsStated) {
  for (int blades = 3; blades <= 16; ++blades) {
    for (double d = 20; d <= 400; d += 7.25) {
      const double edges = polygon_kernel(d, 1, polygon(blades, 3)).edge_count() / d;
      EXPECT_LE(edges, d < 64 ? 4.6 : d < 160 ? 3.5 : 2.1) << blades << " blades, " << d << " px";
    }
  }
}

}  // namespace
}  // namespace pullfocus
