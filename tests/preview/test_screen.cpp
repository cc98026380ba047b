// What the screen shows of colours, depths, diameters and importance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/srgb.h"
#include "preview/screen.h"

namespace pullfocus::cli::preview {
namespace {

const Window window{-2, 1, 11, 8};

int channel(const Picture& picture, int x, int y, int c) {
  const auto at = static_cast<std::size_t>((y - window.y0) * picture.width + (x - window.x0));
  return static_cast<int>(picture.rgba[at] >> (8 * c) & 255);
}

Frame grey_frame(float value = 0.5f) {
  Frame frame{ColourImage(window, SampleType::float32), Plane(window, 5), false, {}};
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, c < 3 ? value : 1);
    }
  }
  return frame;
}

TEST(Screen, EncodesColoursAsSrgbAfterExposure) {
  for (const SampleType type : {SampleType::half, SampleType::float32}) {
    for (const float stops : {-2.f, 0.f, 1.5f}) {
      ColourImage colour(window, type);
      Picture picture;
      int n = 0;
      for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) colour.set(x, y, 1, 0.02f * static_cast<float>(n++) - 0.1f);
      }
      show_colour(colour, ToneTable(stops, true), picture);
      ASSERT_EQ(picture.width, window.width());
      ASSERT_EQ(picture.height, window.height());
      for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) {
          const float linear = std::clamp(colour.get(x, y, 1) * std::exp2(stops), 0.f, 1.f);
          EXPECT_NEAR(channel(picture, x, y, 1), srgb_encoded(linear) * 255, 0.8);
          EXPECT_EQ(channel(picture, x, y, 0), 0);
          EXPECT_EQ(channel(picture, x, y, 3), 255);
        }
      }
    }
  }
}

TEST(Screen, ShowsNaNAsBlackAndWhatIsBrightAsWhite) {
  Frame frame = grey_frame();
  frame.colour.set(0, 2, 0, std::nanf(""));
  frame.colour.set(0, 2, 1, std::numeric_limits<float>::infinity());
  frame.colour.set(0, 2, 2, 1e9f);
  Picture picture;
  show_colour(frame.colour, ToneTable(), picture);
  EXPECT_EQ(channel(picture, 0, 2, 0), 0);
  EXPECT_EQ(channel(picture, 0, 2, 1), 255);
  EXPECT_EQ(channel(picture, 0, 2, 2), 255);
}

TEST(Screen, ShowsDiametersRedInFrontBlueBehindAndGreenInFocus) {
  Frame frame = grey_frame();
  for (int x = window.x0; x < window.x1; ++x) frame.depth.at(x, 3) = static_cast<float>(4 * x - 12);  // -20 .. 28
  const CocFunction coc{DepthKind::coc, 1, 0};
  Picture picture;
  show_coc(frame, &coc, 40, picture);
  for (int x = window.x0; x < window.x1; ++x) {
    const int r = channel(picture, x, 3, 0), g = channel(picture, x, 3, 1), b = channel(picture, x, 3, 2);
    const float diameter = frame.depth.at(x, 3);
    if (std::abs(diameter) <= 1) {
      EXPECT_GT(g, 2 * std::max(r, b));
    } else if (diameter < 0) {
      EXPECT_GT(r, std::max(g, b));
    } else {
      EXPECT_GT(b, std::max(g, r));
    }
  }
  EXPECT_LT(channel(picture, 10, 3, 0), channel(picture, 5, 3, 0)) << "larger is more saturated";
  show_coc(frame, nullptr, 40, picture);
  EXPECT_EQ(channel(picture, 0, 3, 0), channel(picture, 0, 3, 2)) << "without a lens there are no diameters";
}

TEST(Screen, ShowsNearDepthsBrighterThanFarOnesAndBackgroundBlack) {
  Frame frame = grey_frame();
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) frame.depth.at(x, y) = static_cast<float>(x + 3);
  }
  frame.depth.at(4, 4) = 1e10f;
  Picture picture;
  show_depth(frame, DepthKind::planar, picture);
  for (int x = window.x0 + 1; x < window.x1; ++x) {
    EXPECT_LE(channel(picture, x, 2, 0), channel(picture, x - 1, 2, 0));
  }
  EXPECT_GT(channel(picture, window.x0, 2, 0), 200);
  EXPECT_EQ(channel(picture, 4, 4, 0), 0);
  const DepthRange range = depth_range(frame);
  EXPECT_EQ(range.near, 1);
  EXPECT_EQ(range.far, 13);
  EXPECT_EQ(depth_range(Frame{frame.colour, Plane(window, 0), true, {}}).far, 0);
}

TEST(Screen, ShowsTheMoreImportantPixelsBrighterAndOthersBlack) {
  Plane importance(window, 0);
  for (int x = 1; x < window.x1; ++x) importance.at(x, 2) = std::exp2(static_cast<float>(x));
  importance.at(5, 5) = std::numeric_limits<float>::infinity();
  Picture picture;
  show_importance(importance, picture);
  const auto brightness = [&](int x, int y) {
    return channel(picture, x, y, 0) + channel(picture, x, y, 1) + channel(picture, x, y, 2);
  };
  EXPECT_EQ(brightness(0, 2), 0);
  EXPECT_GT(brightness(1, 2), 0);
  for (int x = 2; x < window.x1; ++x) EXPECT_GE(brightness(x, 2), brightness(x - 1, 2)) << x;
  EXPECT_EQ(brightness(5, 5), 3 * 255);
  importance.reset(window, 0);
  show_importance(importance, picture);
  EXPECT_EQ(brightness(5, 5), 0);
}

TEST(Screen, ShowsNoDifferenceAsBlackAndTheRestAsItsSize) {
  const Frame a = grey_frame(0.5f);
  Frame b = grey_frame(0.5f);
  b.colour.set(3, 3, 2, 0.25f);
  Picture picture;
  show_difference(a.colour, b.colour, ToneTable(0, false), picture);
  EXPECT_EQ(channel(picture, 3, 3, 2), 64);
  EXPECT_EQ(channel(picture, 3, 3, 0), 0);
  EXPECT_EQ(channel(picture, 4, 3, 2), 0);
}

TEST(Screen, WipesColumnByColumn) {
  const Frame bright = grey_frame(1), dark = grey_frame(0);
  Picture picture;
  show_colour(bright.colour, ToneTable(), picture);
  show_colour_left_of(4, dark.colour, ToneTable(), picture);
  EXPECT_EQ(channel(picture, window.x0 + 3, 4, 0), 0);
  EXPECT_EQ(channel(picture, window.x0 + 4, 4, 0), 255);
}

}  // namespace
}  // namespace pullfocus::cli::preview
