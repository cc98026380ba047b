// Images in memory: every sample where it belongs, whatever the window's origin.
#include "image/frame.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace pullfocus {
namespace {

const Window windows[] = {{0, 0, 1, 1}, {0, 0, 7, 3}, {-5, -9, 4, -2}, {1000, -1, 1003, 1}, {-1, -1, 0, 70}};
constexpr SampleType types[] = {SampleType::half, SampleType::float32};

template <typename Visit>
void for_each_sample(const Window& w, Visit&& visit) {
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 4; ++c) visit(x, y, c);
    }
  }
}

TEST(ColourImage, KeepsEverySampleApart) {
  for (const Window& w : windows) {
    for (const SampleType type : types) {
      ColourImage image(w, type);
      for_each_sample(w, [&](int x, int y, int c) { ASSERT_EQ(image.get(x, y, c), 0.f); });
      float next = 1;  // whole numbers below 2048 are halves
      for_each_sample(w, [&](int x, int y, int c) { image.set(x, y, c, next++); });
      float expected = 1;
      for_each_sample(w, [&](int x, int y, int c) { ASSERT_EQ(image.get(x, y, c), expected++); });
    }
  }
}

TEST(ColourImage, LiesRowAfterRowWithoutGaps) {
  for (const Window& w : windows) {
    for (const SampleType type : types) {
      const ColourImage image(w, type);
      EXPECT_EQ(image.pixel_bytes(), type == SampleType::half ? 8u : 16u);
      EXPECT_EQ(image.row_bytes(), image.pixel_bytes() * static_cast<std::size_t>(w.width()));
      std::ptrdiff_t expected = 0;
      for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x) {
          ASSERT_EQ(image.pixel(x, y) - image.pixel(w.x0, w.y0), expected);
          expected += static_cast<std::ptrdiff_t>(image.pixel_bytes());
        }
      }
    }
  }
}

TEST(ColourImage, StoresFloatsByTheirBitsAndHalvesRoundedToNearestEven) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(-70000, 70000);
  ColourImage wide({-1, -1, 1, 1}, SampleType::float32), narrow({-1, -1, 1, 1}, SampleType::half);
  for (int i = 0; i < 10000; ++i) {
    const float v = value(random) / static_cast<float>(1 + i * i);
    wide.set(-1, 0, 2, v);
    narrow.set(-1, 0, 2, v);
    ASSERT_EQ(wide.get(-1, 0, 2), v);
    ASSERT_EQ(narrow.get(-1, 0, 2), imath_half_to_float(imath_float_to_half(v)));
  }
  narrow.set(0, 0, 0, 2049.f);  // between 2048 and 2050
  EXPECT_EQ(narrow.get(0, 0, 0), 2048.f);
  narrow.set(0, 0, 0, 2051.f);
  EXPECT_EQ(narrow.get(0, 0, 0), 2052.f);
}

TEST(ColourImage, EqualsAnotherOfTheSameWindowTypeAndBits) {
  const ColourImage image({0, 0, 4, 4}, SampleType::half);
  ColourImage other = image;
  EXPECT_EQ(image, other);
  other.set(3, 3, 3, -0.f);
  EXPECT_NE(image, other) << "-0 has other bits than 0";
  EXPECT_NE(image, ColourImage({1, 0, 5, 4}, SampleType::half));
  EXPECT_NE(image, ColourImage({0, 0, 4, 4}, SampleType::float32));
}

TEST(ColourImage, IsZeroAgainAfterReset) {
  ColourImage image({0, 0, 4, 4}, SampleType::float32);
  for_each_sample(image.window(), [&](int x, int y, int c) { image.set(x, y, c, 7.f); });
  const Window smaller{-1, -1, 2, 1};
  image.reset(smaller, SampleType::half);
  EXPECT_EQ(image, ColourImage(smaller, SampleType::half));
  image.reset({}, SampleType::half);
  EXPECT_TRUE(image.window().empty());
}

TEST(Plane, KeepsEveryValueApart) {
  for (const Window& w : windows) {
    Plane plane(w, 3.f);
    float next = 0;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        ASSERT_EQ(plane.at(x, y), 3.f);
        plane.at(x, y) = next++;
      }
    }
    const Plane& constant = plane;
    float expected = 0;
    for (int y = w.y0; y < w.y1; ++y) {
      EXPECT_EQ(constant.row(y)[0], expected);
      for (int x = w.x0; x < w.x1; ++x) {
        ASSERT_EQ(constant.at(x, y), expected);
        ASSERT_EQ(constant.row(y)[x - w.x0], expected++);
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus
