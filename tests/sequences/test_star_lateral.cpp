#include "star_lateral.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "image/error.h"

namespace pullfocus::sequences {
namespace {

constexpr StarLateral small{160, 90};

void for_each_pixel(const Frame& frame, const std::function<void(int, int)>& visit) {
  for (int y = frame.window().y0; y < frame.window().y1; ++y)
    for (int x = frame.window().x0; x < frame.window().x1; ++x) visit(x, y);
}

bool same_pixel(const Frame& a, const Frame& b, int x, int y) {
  return std::memcmp(a.colour.pixel(x, y), b.colour.pixel(x, y), a.colour.pixel_bytes()) == 0 &&
         std::memcmp(&a.depth.row(y)[x], &b.depth.row(y)[x], sizeof(float)) == 0;
}

std::size_t changed_pixels(const Frame& a, const Frame& b) {
  std::size_t changed = 0;
  for_each_pixel(a, [&](int x, int y) { changed += !same_pixel(a, b, x, y); });
  return changed;
}

CocFunction coc_of(const StarLateral& scene) {
  return coc_function(star_lens(scene), {scene.width, scene.height}, DepthKind::planar);
}

Frame with_threads(std::size_t count, int frame) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
  Frame out;
  render(small, frame, out);
  return out;
}

TEST(StarLateral, FramesAreTheSameForOneAndFourThreads) {
  for (int frame : {1, 37, 100}) EXPECT_EQ(changed_pixels(with_threads(1, frame), with_threads(4, frame)), 0u);
}

TEST(StarLateral, FramesDoNotDependOnThoseRenderedBefore) {
  const StarLateralRenderer renderer(small);
  Frame in_turn, alone;
  for (int frame : {1, 80, 20}) renderer.render(frame, in_turn);
  render(small, 20, alone);
  EXPECT_EQ(changed_pixels(in_turn, alone), 0u);
}

TEST(StarLateral, OnlyPixelsNearTheStarChange) {
  const StarLateralRenderer renderer(small);
  Frame before, now;
  renderer.render(1, before);
  for (int frame : {2, 3, 40, 100}) {
    renderer.render(frame, now);
    const Window a = star_window(small, 1), b = star_window(small, frame);
    for_each_pixel(now, [&](int x, int y) {
      if (!a.contains(x, y) && !b.contains(x, y)) {
        ASSERT_TRUE(same_pixel(before, now, x, y)) << x << "," << y;
      }
    });
    EXPECT_GT(changed_pixels(before, now), 0u);
  }
}

TEST(StarLateral, FewPixelsChangeFromFrameToFrame) {
  const StarLateral scene{256, 256};
  const StarLateralRenderer renderer(scene);
  Frame before, now;
  renderer.render(1, before);
  for (int frame = 2; frame <= 100; ++frame) {
    renderer.render(frame, now);
    EXPECT_LT(static_cast<double>(changed_pixels(before, now)), 0.03 * 256 * 256) << frame;
    std::swap(before, now);
  }
}

TEST(StarLateral, StarIsExactlyInFocusAndMovesFromLeftToRight) {
  const StarLateral scene{256, 256};
  const StarLateralRenderer renderer(scene);
  const CocFunction coc = coc_of(scene);
  double mean_before = -1;
  for (int frame : {1, 20, 35, 65, 80, 100}) {
    Frame out;
    renderer.render(frame, out);
    double sum = 0;
    int count = 0;
    for_each_pixel(out, [&](int x, int y) {
      if (out.depth.at(x, y) != 0.040f) return;
      EXPECT_EQ(coc(out.depth.at(x, y)), 0.0f);
      EXPECT_TRUE(star_window(scene, frame).contains(x, y));
      sum += x;
      ++count;
    });
    ASSERT_GT(count, 100) << frame;
    EXPECT_GT(sum / count, mean_before);
    mean_before = sum / count;
  }
}

TEST(StarLateral, StarIsHiddenByTheCordInTheMiddleOfTheShot) {
  const auto star_pixels = [](int frame) {
    Frame out;
    render(small, frame, out);
    int count = 0;
    for_each_pixel(out, [&](int x, int y) { count += out.depth.at(x, y) == 0.040f; });
    return count;
  };
  EXPECT_LT(star_pixels(51), star_pixels(1) / 4);
}

TEST(StarLateral, LargestDiameterAt256PixelsIs64AndManySizesOccur) {
  const StarLateral scene{256, 256};
  const CocFunction coc = coc_of(scene);
  Frame out;
  render(scene, 1, out);
  float largest = 0;
  std::vector<int> sizes;
  for_each_pixel(out, [&](int x, int y) {
    const float diameter = coc(out.depth.at(x, y));
    largest = std::max(largest, std::abs(diameter));
    sizes.push_back(static_cast<int>(diameter));
  });
  EXPECT_NEAR(largest, 64, 0.01);
  std::sort(sizes.begin(), sizes.end());
  const auto distinct = std::unique(sizes.begin(), sizes.end()) - sizes.begin();
  EXPECT_GT(distinct, 40);
}

TEST(StarLateral, FilmKeepsSquarePixelsAtEverySize) {
  for (const StarLateral& scene : {StarLateral{256, 256}, StarLateral{1920, 1080}, StarLateral{90, 160}}) {
    const double width = star_lens(scene).sensor_mm, height = star_sensor_height_mm(scene);
    EXPECT_NEAR(width / height, static_cast<double>(scene.width) / scene.height, 1e-12);
    EXPECT_NEAR(std::min(width, height), 16.0 / 7, 1e-12);
  }
}

TEST(StarLateral, EverySizeHasSoundDepthsAndColours) {
  for (const StarLateral& scene : {StarLateral{1, 1}, StarLateral{7, 3}, StarLateral{3, 7}, StarLateral{400, 1},
                                   StarLateral{1, 400}, StarLateral{128, 96}}) {
    Frame out;
    render(scene, 30, out);
    ASSERT_EQ(out.window(), (Window{0, 0, scene.width, scene.height}));
    ASSERT_EQ(out.depth.window(), out.window());
    EXPECT_EQ(out.colour.type(), SampleType::half);
    EXPECT_FALSE(out.has_alpha);
    for_each_pixel(out, [&](int x, int y) {
      const float depth = out.depth.at(x, y);
      ASSERT_TRUE(depth >= 0.0199f && depth < 3.0f) << x << "," << y << ": " << depth;
      for (int channel = 0; channel < 3; ++channel) {
        const float value = out.colour.get(x, y, channel);
        ASSERT_TRUE(value >= 0 && value <= 65504) << x << "," << y << ": " << value;
      }
      ASSERT_EQ(out.colour.get(x, y, 3), 1.0f);
    });
  }
}

TEST(StarLateral, SomeLightsAreBrighterThanWhite) {
  Frame out;
  render(small, 1, out);
  int bright = 0;
  for_each_pixel(out, [&](int x, int y) { bright += out.colour.get(x, y, 0) > 4; });
  EXPECT_GT(bright, 10);
}

TEST(StarLateral, StandsStillOutsideItsFrames) {
  const StarLateralRenderer renderer({64, 64, 10, 20});
  Frame end, beyond;
  renderer.render(10, end);
  renderer.render(-5, beyond);
  EXPECT_EQ(changed_pixels(end, beyond), 0u);
  renderer.render(20, end);
  EXPECT_GT(changed_pixels(end, beyond), 0u);
  renderer.render(1000, beyond);
  EXPECT_EQ(changed_pixels(end, beyond), 0u);
}

TEST(StarLateral, ImpossibleScenesAreRefused) {
  for (const StarLateral& scene : {StarLateral{0, 10}, StarLateral{10, -1}, StarLateral{10, 10, 5, 4}}) try {
      const StarLateralRenderer renderer(scene);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
    }
  EXPECT_NO_THROW(validate({1, 1, 5, 5}));
}

}  // namespace
}  // namespace pullfocus::sequences
