// SSIM: against values of another implementation, against the definition written out, and where the truth is known.
#include "metrics/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/srgb.h"
#include "pictures.h"

namespace pullfocus::test {
namespace {

// scikit-image 0.19.3, structural_similarity(gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
// data_range=1) of the same luma in double precision.
TEST(Ssim, AgreesWithScikitImageOnTheFormulaPair) {
  const struct {
    int width, height;
    double ssim;
  } cases[] = {{61, 47, 0.8732741}, {128, 96, 0.8869591}, {13, 30, 0.5544226}};
  for (const auto& c : cases) {
    const auto [a, b] = formula_pair(c.width, c.height);
    EXPECT_NEAR(ssim(a, b, a.window()), c.ssim, 2e-7) << c.width;
  }
}

// The definition over one pixel's 121 neighbours, two passes, no separation.
double plain_ssim(const ColourImage& a, const ColourImage& b, int x, int y) {
  const Window& w = a.window();
  const auto luma = [&](const ColourImage& image, int i, int j) {
    double sum = 0;
    const double weights[3] = {0.2126, 0.7152, 0.0722};
    for (int c = 0; c < 3; ++c) {
      const float v = image.get(std::clamp(i, w.x0, w.x1 - 1), std::clamp(j, w.y0, w.y1 - 1), c);
      sum += weights[c] * static_cast<double>(srgb_encoded(std::clamp(v, 0.f, 1.f)));
    }
    return sum;
  };
  const auto weighted = [&](auto&& value) {
    double sum = 0, weights = 0;
    for (int j = -5; j <= 5; ++j) {
      for (int i = -5; i <= 5; ++i) {
        const double weight = std::exp(-(i * i + j * j) / 4.5);
        sum += weight * value(x + i, y + j);
        weights += weight;
      }
    }
    return sum / weights;
  };
  const double ma = weighted([&](int i, int j) { return luma(a, i, j); });
  const double mb = weighted([&](int i, int j) { return luma(b, i, j); });
  const double va = weighted([&](int i, int j) { return std::pow(luma(a, i, j) - ma, 2); });
  const double vb = weighted([&](int i, int j) { return std::pow(luma(b, i, j) - mb, 2); });
  const double ab = weighted([&](int i, int j) { return (luma(a, i, j) - ma) * (luma(b, i, j) - mb); });
  return (2 * ma * mb + 1e-4) * (2 * ab + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
}

TEST(Ssim, MapIsTheDefinitionAtEveryPixelBordersAndOddSizesIncluded) {
  unsigned seed = 7;
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 8}, {23, 17}, {11, 12}}) {
    const Window w{4, -9, 4 + width, -9 + height};
    const ColourImage a = random_picture(w, seed++, 1.5f), b = random_picture(w, seed++, 1.5f);
    const Plane map = ssim_map(a, b, w);
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        ASSERT_NEAR(static_cast<double>(map.at(x, y)), plain_ssim(a, b, x, y), 1e-6) << x << "," << y;
      }
    }
  }
}

TEST(Ssim, OfConstantPicturesIsTheLuminanceTerm) {
  const Window w{0, 0, 16, 16};
  const double a = static_cast<double>(srgb_encoded(0.25f)), b = static_cast<double>(srgb_encoded(0.5f));
  const double expected = (2 * a * b + 1e-4) / (a * a + b * b + 1e-4);
  EXPECT_NEAR(ssim(constant(w, 0.25f, 0.25f, 0.25f), constant(w, 0.5f, 0.5f, 0.5f), w), expected, 1e-5);
}

TEST(Ssim, IsSymmetricAndAtMostOne) {
  const auto [a, b] = formula_pair(40, 30);
  EXPECT_DOUBLE_EQ(ssim(a, b, a.window()), ssim(b, a, a.window()));
  EXPECT_LT(ssim(a, b, a.window()), 1);
}

}  // namespace
}  // namespace pullfocus::test
