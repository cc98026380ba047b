// RMSE, PSNR, relative MSE and largest error: against OpenImageIO's compare, and where the truth is known.
#include "metrics/differences.h"

#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/error.h"
#include "metrics/metrics.h"
#include "metrics/planes.h"
#include "pictures.h"

namespace pullfocus::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

OIIO::ImageBuf rgb_buffer(const ColourImage& image) {
  const Window& w = image.window();
  OIIO::ImageBuf buffer(OIIO::ImageSpec(w.width(), w.height(), 3, OIIO::TypeDesc::FLOAT));
  for (int y = 0; y < w.height(); ++y) {
    for (int x = 0; x < w.width(); ++x) {
      const float rgb[3] = {image.get(w.x0 + x, w.y0 + y, 0), image.get(w.x0 + x, w.y0 + y, 1),
                            image.get(w.x0 + x, w.y0 + y, 2)};
      buffer.setpixel(x, y, rgb);
    }
  }
  return buffer;
}

TEST(Differences, RmsePsnrAndLargestErrorAgreeWithOpenImageIo) {
  unsigned seed = 1;
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 8}, {67, 31}, {128, 64}}) {
    const Window w{-5, 7, -5 + width, 7 + height};
    const ColourImage a = random_picture(w, seed), b = random_picture(w, seed + 1);
    seed += 2;
    const auto oiio = OIIO::ImageBufAlgo::compare(rgb_buffer(a), rgb_buffer(b), 1.f, 1.f);
    const Differences ours = differences(a, b, w);
    EXPECT_NEAR(ours.rmse(), oiio.rms_error, 1e-7);
    EXPECT_NEAR(ours.psnr(1), oiio.PSNR, 1e-4);
    EXPECT_NEAR(ours.largest, oiio.maxerror, 1e-7);
  }
}

TEST(Differences, AreAnalyticForConstantPictures) {
  const Window w{0, 0, 9, 5};
  const Differences d = differences(constant(w, 0.5f, 0.25f, 0), constant(w, 0.25f, 0.25f, 0.5f), w);
  EXPECT_DOUBLE_EQ(d.mse, (0.0625 + 0 + 0.25) / 3);
  EXPECT_DOUBLE_EQ(d.relative_mse, (0.0625 / (0.0625 + 0.01) + 0.25 / (0.25 + 0.01)) / 3);
  EXPECT_DOUBLE_EQ(d.largest, 0.5);
  EXPECT_DOUBLE_EQ(d.psnr(1), -10 * std::log10(0.3125 / 3));
  EXPECT_NEAR(differences(constant(w, 0.1f, 0.1f, 0.1f), constant(w, 0.2f, 0.2f, 0.2f), w).psnr(1), 20, 1e-5);
}

TEST(Differences, OfEqualPicturesAreExactlyZeroAndTheirPsnrIsInfinite) {
  const Window w{0, 0, 33, 17};
  const ColourImage a = random_picture(w, 5, 1e4f);
  const PictureErrors e = picture_errors(a, a, w);
  EXPECT_EQ(e.differences.mse, 0);
  EXPECT_EQ(e.differences.relative_mse, 0);
  EXPECT_EQ(e.differences.largest, 0);
  EXPECT_EQ(e.differences.psnr(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(e.ssim, 1);
  EXPECT_EQ(e.flip, 0);
  EXPECT_EQ(ssim(a, a, w), 1);
  EXPECT_EQ(flip(a, a, w), 0);
}

TEST(Differences, PsnrIsOfWhatIsShownUpToThePeakAndTheOthersAreNot) {
  const Window w{0, 0, 4, 4};
  const ColourImage lamp = constant(w, 100, 2, -1), brighter = constant(w, 200, 2, -3);
  EXPECT_EQ(differences(lamp, brighter, w).psnr(1), std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(differences(lamp, brighter, w).largest, 100);
  EXPECT_DOUBLE_EQ(differences(lamp, brighter, w, 1000).psnr(1000), 10 * std::log10(3e6 / 1e4));
}

TEST(Differences, AlphaCountsInTheLargestErrorAlone) {
  const Window w{0, 0, 4, 4};
  ColourImage a = constant(w, 1, 1, 1), b = a;
  b.set(2, 3, 3, 0.25f);
  EXPECT_EQ(differences(a, b, w).largest, 0.75);
  EXPECT_EQ(differences(a, b, w).mse, 0);
}

TEST(Differences, OutsideAPictureEverythingIsZeroAndOnlyTheWindowCounts) {
  const ColourImage small = constant({0, 0, 2, 2}, 1, 1, 1), large = constant({0, 0, 4, 2}, 1, 1, 1);
  EXPECT_DOUBLE_EQ(differences(small, large, {0, 0, 4, 2}).mse, 0.5);
  EXPECT_EQ(differences(small, large, {0, 0, 2, 2}).largest, 0);
  EXPECT_NE(flip(small, large, {0, 0, 4, 2}), 0);
  EXPECT_NE(ssim(small, large, {0, 0, 4, 2}), 1);
}

TEST(Differences, NanInEitherPictureIsNeverTakenForNoError) {
  const Window w{0, 0, 20, 20};
  const ColourImage good = random_picture(w, 3);
  for (const auto& [x, y] : {std::pair{0, 0}, {10, 10}, {19, 19}}) {
    ColourImage bad = good;
    bad.set(x, y, 1, kNan);
    for (const PictureErrors& e : {picture_errors(bad, good, w), picture_errors(good, bad, w)}) {
      EXPECT_TRUE(std::isnan(e.differences.mse));
      EXPECT_TRUE(std::isnan(e.differences.largest));
      EXPECT_TRUE(std::isfinite(e.ssim) && std::isfinite(e.flip));
    }
  }
  ColourImage infinite = good;
  infinite.set(1, 1, 0, kInfinity);
  EXPECT_EQ(differences(infinite, infinite, w).largest, 0);
  EXPECT_EQ(differences(infinite, good, w).largest, std::numeric_limits<double>::infinity());
}

TEST(Differences, TheMapsMeanSquareIsTheMse) {
  const Window w{3, -2, 40, 20};
  const ColourImage a = random_picture(w, 1), b = random_picture(w, 2);
  const Plane map = difference_map(a, b, w);
  Plane squares(w, 0);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) squares.at(x, y) = map.at(x, y) * map.at(x, y);
  }
  EXPECT_NEAR(mean(squares, w), differences(a, b, w).mse, 1e-7);
}

TEST(Differences, RefuseAnEmptyWindowAndAPeakThatIsNone) {
  const ColourImage a = constant({0, 0, 2, 2}, 0, 0, 0);
  EXPECT_THROW(picture_errors(a, a, {0, 0, 0, 2}), Error);
  EXPECT_THROW(ssim(a, a, {2, 2, 1, 1}), Error);
  EXPECT_THROW(flip(a, a, {}), Error);
  for (const double peak : {0., -1., std::nan("")}) EXPECT_THROW(differences(a, a, {0, 0, 2, 2}, peak), Error);
}

}  // namespace
}  // namespace pullfocus::test
