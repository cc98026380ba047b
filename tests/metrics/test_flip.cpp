// FLIP: against values of the authors' formulas computed elsewhere, against fixed figures, and where the
// truth is known.
#include "metrics/flip.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <limits>

#include "image/error.h"
#include "pictures.h"

namespace pullfocus::test {
namespace {

// The authors' Python version of LDR-FLIP, its two-dimensional filters evaluated by SciPy in double precision on the
// linear values of the pair.
TEST(Flip, AgreesWithTheAuthorsPythonVersionOnTheFormulaPair) {
  const struct {
    int width, height;
    double mean, largest, at_5_9, mean_at_20_ppd;
  } cases[] = {{61, 47, 0.3596529, 0.9628061, 0.1381901, 0.4394669},
               {128, 96, 0.3636232, 0.9703462, 0.1381901, 0.5584820},
               {13, 30, 0.4749344, 0.9670307, 0.4544106, 0.4788761}};
  for (const auto& c : cases) {
    const auto [a, b] = formula_pair(c.width, c.height);
    const Plane map = flip_map(b, a, a.window());
    float largest = 0;
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) largest = std::max(largest, map.at(x, y));
    }
    EXPECT_NEAR(flip(b, a, a.window()), c.mean, 2e-7) << c.width;
    EXPECT_NEAR(largest, c.largest, 1e-6) << c.width;
    EXPECT_NEAR(map.at(5, 9), c.at_5_9, 1e-6) << c.width;
    EXPECT_NEAR(flip(b, a, a.window(), 20), c.mean_at_20_ppd, 2e-7) << c.width;
  }
}

TEST(Flip, IsOneBetweenGreenAndBlueAndZeroBetweenEqualColours) {
  const Window w{0, 0, 12, 9};
  EXPECT_NEAR(flip(constant(w, 0, 1, 0), constant(w, 0, 0, 1), w), 1, 1e-6);
  EXPECT_EQ(flip(constant(w, 0.3f, 0.2f, 0.1f), constant(w, 0.3f, 0.2f, 0.1f), w), 0);
}

// Without features dE is dE_c. Grey to black: HyAB is L* of the grey; to green-blue's 308 or so by hand from CIE 1976.
TEST(Flip, OfGreysIsTheRedistributedDifferenceOfLightness) {
  const Window w{0, 0, 8, 8};
  const auto lab = [](double x, double y, double z) {
    const double fx = std::cbrt(x), fy = std::cbrt(y), fz = std::cbrt(z), l = 116 * fy - 16;
    return std::array{l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
  };
  // Rec. 709 green and blue over D65's X, Y, Z.
  const auto green = lab(0.357580 / 0.950456, 0.715160, 0.119193 / 1.088754);
  const auto blue = lab(0.180423 / 0.950456, 0.072169, 0.950227 / 1.088754);
  const double largest = std::fabs(green[0] - blue[0]) + std::hypot(green[1] - blue[1], green[2] - blue[2]);
  const double lightness = 116 * std::cbrt(0.2) - 16;
  const double expected = 0.95 * std::pow(lightness / largest, 0.7) / 0.4;
  EXPECT_LT(expected, 0.95);
  EXPECT_NEAR(flip(constant(w, 0.2f, 0.2f, 0.2f), constant(w, 0, 0, 0), w), expected, 1e-3);
}

TEST(Flip, IsSymmetricWithinRangeAndLocal) {
  const Window w{-3, 2, 60, 50};
  const ColourImage a = random_picture(w, 1);
  ColourImage b = a;
  b.set(20, 20, 0, 1 - b.get(20, 20, 0));
  const Plane there = flip_map(a, b, w), back = flip_map(b, a, w);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      EXPECT_EQ(there.at(x, y), back.at(x, y));
      EXPECT_TRUE(there.at(x, y) >= 0 && there.at(x, y) <= 1);
      if (std::abs(x - 20) > 10 || std::abs(y - 20) > 10) {
        EXPECT_EQ(there.at(x, y), 0);
      }
    }
  }
  EXPECT_GT(there.at(20, 20), 0.05f);
}

TEST(Flip, GivesTheSameBitsWithAnyNumberOfThreads) {
  const auto [a, b] = formula_pair(90, 70);
  const double many = flip(a, b, a.window());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(flip(a, b, a.window()), many);
}

TEST(Flip, TakesNanForBlackAndLampsForWhiteAndSinglePixels) {
  const Window w{0, 0, 1, 1};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(flip(constant(w, nan, nan, nan), constant(w, 0, -1, 0), w), 0);
  EXPECT_EQ(flip(constant(w, 1, 1, 1), constant(w, 7, 1e30f, std::numeric_limits<float>::infinity()), w), 0);
}

TEST(Flip, RefusesPixelsPerDegreeThatAreNone) {
  const auto [a, b] = formula_pair(5, 5);
  for (const double ppd : {0., -3., 1e9, std::nan("")}) EXPECT_THROW(flip(a, b, a.window(), ppd), Error) << ppd;
}

}  // namespace
}  // namespace pullfocus::test
