// Gaussian, diffraction and picture kernels against independent integrals.
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>

#include "scatter/aperture_image.h"
#include "scatter/diffraction.h"
#include "scatter/disc.h"
#include "scatter/gaussian.h"
#include "shapes.h"

namespace pullfocus {
namespace {

using std::numbers::pi;
using test::moments_of;
using test::true_moment;

TEST(Gaussian, StandardDeviationIsAQuarterOfTheDiameter) {
  for (double d = 4; d <= 500; d += d < 80 ? 1. / 16 : 17.0625) {
    const test::Moments m = moments_of(gaussian_kernel(d));
    const double tolerance = (d < 12 ? 0.04 : 0.011) * true_moment(d);
    ASSERT_NEAR(m.xx, true_moment(d), tolerance) << d;
    ASSERT_NEAR(m.yy, true_moment(d), tolerance) << d;
  }
  for (const double aspect : {0.5, 2.}) {
    const test::Moments m = moments_of(gaussian_kernel(40, aspect));
    EXPECT_NEAR(m.xx, true_moment(40), 0.02 * true_moment(40));
    EXPECT_NEAR(m.yy, true_moment(40 * aspect), 0.02 * true_moment(40 * aspect));
  }
}

TEST(Gaussian, NoPixelIsOffByMoreThan5PercentOfThePeak) {
  for (const double d : {4., 8., 20., 60., 150.}) {
    const Kernel kernel = gaussian_kernel(d);
    const double s = 1.02628 * d / 4, cut = 3 * s;
    double worst = 0;
    for (int dy = 0; dy <= kernel.radius_y + 2; ++dy) {
      for (int dx = 0; dx <= kernel.radius_x + 2; ++dx) {
        double mean = 0;  // by 8 x 8 points
        for (int i = 0; i < 64; ++i) {
          const double x = dx - 0.5 + (i % 8 + 0.5) / 8, y = dy - 0.5 + (i / 8 + 0.5) / 8;
          mean += std::exp(-(x * x + y * y) / (2 * s * s)) / 64;
        }
        if (dx * dx + dy * dy > cut * cut) mean = 0;
        const double share = static_cast<double>(kernel.weight(dx, dy)) / static_cast<double>(kWeightUnit);
        worst = std::max(worst, std::fabs(share * 2 * pi * s * s * 0.988891 - mean));
      }
    }
    EXPECT_LE(worst, 0.05) << d;
  }
}

// |2 times the integral of J0(v r) exp(-i u r^2 / 2) r dr over 0..1|^2, relative to the flat disc's (2 / u)^2.
double by_integration(double u, double rho) {
  std::complex<double> sum = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) / n;
    sum += std::cyl_bessel_j(0., u * rho * r) * std::polar(1., -u * r * r / 2) * r / static_cast<double>(n);
  }
  return std::norm(2. * sum) * u * u / 4;
}

TEST(Diffraction, IsTheFresnelIntegralOverWavelengths) {
  for (const double rho : {0., 0.04, 0.3, 0.75, 0.97, 1., 1.03, 1.2, 1.5}) {
    double mean = 0;
    for (int i = 0; i < 16; ++i) mean += by_integration(64 * 550 / (400 + 300 * (i + 0.5) / 16), rho) / 16;
    EXPECT_NEAR(DiffractionProfile::exact(rho), mean, 2e-3) << rho;
  }
}

TEST(Diffraction, TheProfileKeepsTheLightAndHasItsRingAtThreeQuarters) {
  const DiffractionProfile profile;
  double light = 0, peak = 0, at = 0;
  for (int i = 0; i < 2000; ++i) {
    const double rho = (i + 0.5) / 2000 * DiffractionProfile::kOuter, value = profile.at(rho * rho);
    light += value * 2 * rho * DiffractionProfile::kOuter / 2000;
    if (value > peak) peak = value, at = rho;
  }
  EXPECT_NEAR(light, 0.985, 0.01);  // of the flat disc's; the rest falls farther out
  EXPECT_NEAR(peak, 1.29, 0.02);
  EXPECT_NEAR(at, 0.74, 0.02);
  EXPECT_EQ(profile.at(DiffractionProfile::kOuter * DiffractionProfile::kOuter + 1e-6), 0);
}

TEST(Diffraction, NoPixelIsOffByMoreThan012FlatDiscs) {
  const DiffractionProfile profile;
  for (const double d : {4., 9., 20., 60., 150.}) {
    const Kernel kernel = diffraction_kernel(d, 1, profile);
    double kept = 0;
    std::vector<double> means, shares;
    for (int dy = -kernel.radius_y - 2; dy <= kernel.radius_y + 2; ++dy) {
      for (int dx = -kernel.radius_x - 2; dx <= kernel.radius_x + 2; ++dx) {
        double mean = 0;
        for (int i = 0; i < 144; ++i) {
          const double x = dx - 0.5 + (i % 12 + 0.5) / 12, y = dy - 0.5 + (i / 12 + 0.5) / 12;
          mean += profile.at((x * x + y * y) * 4 / (d * d)) / 144;
        }
        means.push_back(mean);
        shares.push_back(static_cast<double>(kernel.weight(dx, dy)) / static_cast<double>(kWeightUnit));
        if (shares.back() > 0) kept += mean;
      }
    }
    double worst = 0;
    for (std::size_t i = 0; i < means.size(); ++i) worst = std::max(worst, std::fabs(shares[i] * kept - means[i]));
    EXPECT_LE(worst, 0.12) << d;
    EXPECT_LE(kernel.levels.size(), 9u);
  }
}

TEST(Diffraction, SecondMomentsAreALittleBelowTheDiscs) {
  const DiffractionProfile profile;
  for (double d = 4; d <= 500; d += d < 80 ? 3. / 16 : 17.0625) {
    const test::Moments m = moments_of(diffraction_kernel(d, 1, profile));
    EXPECT_NEAR(m.xx, 0.94 * true_moment(d), 0.03 * true_moment(d)) << d;
    EXPECT_NEAR(m.xx, m.yy, 1e-12 * m.xx) << d;
  }
}

TEST(Smooth, CostWhatIsStated) {
  const DiffractionProfile profile;
  for (double d = 4; d <= 400; d += d < 40 ? 0.5 : 21.5) {
    EXPECT_LE(gaussian_kernel(d).edge_count(), 25.5 * d) << d;
    EXPECT_LE(diffraction_kernel(d, 1, profile).edge_count(), 17.5 * d) << d;
  }
}

TEST(ApertureImage, OfADiscIsTheDisc) {
  const KernelShape shape = test::picture_of(512, 512, [](double x, double y) { return x * x + y * y <= 1; });
  const ApertureImage image(*shape.picture);
  for (double d = 8; d <= 400; d += d < 80 ? 0.5 : 21.5) {
    const test::Moments m = moments_of(image.kernel(d, 1));
    EXPECT_NEAR(m.xx, true_moment(d), 0.01 * true_moment(d)) << d;
    EXPECT_NEAR(m.yy, true_moment(d), 0.01 * true_moment(d)) << d;
  }
  const Kernel a = image.kernel(40, 2), b = disc_kernel(40, 2);
  EXPECT_NEAR(a.radius_x, b.radius_x, 1);
  EXPECT_NEAR(a.radius_y, b.radius_y, 1);
}

TEST(ApertureImage, StandsUprightCentredAndAsWideAsTheCoc) {
  // One bright quarter, top left, of a picture twice as wide as high.
  const KernelShape shape = test::picture_of(8, 4, [](double x, double y) { return x < 0 && y < 0; });
  const Kernel kernel = ApertureImage(*shape.picture).kernel(32, 1);
  EXPECT_EQ(kernel.radius_x, 16);
  EXPECT_EQ(kernel.radius_y, 8);
  EXPECT_GT(kernel.weight(-8, -4), 0);
  for (const auto& [x, y] : {std::pair{8, -4}, {8, 4}, {-8, 4}}) EXPECT_EQ(kernel.weight(x, y), 0);
  const test::Moments m = moments_of(kernel);
  EXPECT_NEAR(m.x, -8, 0.01);
  EXPECT_NEAR(m.y, -4, 0.01);
}

TEST(ApertureImage, PixelsAreMeansOfTheLuminanceWithinHalfALevel) {
  const KernelShape shape = test::noise_picture();
  for (const double d : {5., 16., 23.5, 64.}) {
    const Kernel kernel = ApertureImage(*shape.picture).kernel(d, 1);
    std::vector<double> means, shares;
    double sum = 0, peak = 0;
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) {
        double mean = 0;
        constexpr int n = 32;
        for (int i = 0; i < n * n; ++i) {
          const double x = (dx - 0.5 + (i % n + 0.5) / n) * 64 / d + 32,
                       y = (dy - 0.5 + (i / n + 0.5) / n) * 64 / d + 32;
          if (x < 0 || y < 0 || x >= 64 || y >= 64) continue;
          mean += static_cast<double>(
                      shape.picture->luminance[static_cast<std::size_t>(y) * 64 + static_cast<std::size_t>(x)]) /
                  (n * n);
        }
        means.push_back(mean);
        peak = std::max(peak, mean);
        shares.push_back(static_cast<double>(kernel.weight(dx, dy)) / static_cast<double>(kWeightUnit));
        if (shares.back() > 0) sum += mean;
      }
    }
    double worst = 0;
    for (std::size_t i = 0; i < means.size(); ++i) worst = std::max(worst, std::fabs(shares[i] * sum - means[i]));
    EXPECT_LE(worst, peak / 16 + 0.02) << d;  // levels carry the mean of their pixels: up to a level's width
  }
}

}  // namespace
}  // namespace pullfocus
