// Focusing on what a pixel shows.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "preview/pick.h"

namespace pullfocus::cli::preview {
namespace {

Frame two_surfaces(float near, float far, float between) {
  const Window window{-4, 3, 60, 51};
  Frame frame{ColourImage(window, SampleType::half), Plane(window, far), false, {}};
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < 20; ++x) frame.depth.at(x, y) = near;
    frame.depth.at(20, y) = between;
    for (int x = window.x0; x < window.x1; ++x) frame.colour.set(x, y, 3, 1);
  }
  return frame;
}

TEST(Picking, GivesThePixelsDepthOnASurface) {
  const Frame frame = two_surfaces(2, 8, 8);
  EXPECT_EQ(focus_distance_at(frame, DepthKind::planar, 5, 20), 2);
  EXPECT_EQ(focus_distance_at(frame, DepthKind::planar, 19, 20), 2);
  EXPECT_EQ(focus_distance_at(frame, DepthKind::planar, 40, 20), 8);
  EXPECT_EQ(focus_distance_at(frame, DepthKind::planar, -4, 3), 2);
  EXPECT_EQ(focus_distance_at(frame, DepthKind::planar, 59, 50), 8);
}

TEST(Picking, OfADepthThatAFilterMixedGivesTheSurfaceItMostlyIs) {
  EXPECT_EQ(focus_distance_at(two_surfaces(2, 8, 3), DepthKind::planar, 20, 20), 2);
  EXPECT_EQ(focus_distance_at(two_surfaces(2, 8, 7), DepthKind::planar, 20, 20), 8);
}

TEST(Picking, OfBackgroundFocusesAtInfinity) {
  for (const float empty : {0.f, 1e10f, std::numeric_limits<float>::infinity(), std::nanf(""), -1.f}) {
    EXPECT_TRUE(std::isinf(focus_distance_at(two_surfaces(2, empty, empty), DepthKind::planar, 40, 20))) << empty;
  }
}

TEST(Picking, OnASlantedFloorIsThatPixelsOwnDepth) {
  Frame frame = two_surfaces(1, 1, 1);
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) frame.depth.at(x, y) = 1 / (0.9f - 0.01f * static_cast<float>(y));
  }
  for (const int y : {3, 20, 50}) {
    EXPECT_EQ(focus_distance_at(frame, DepthKind::planar, 7, y), static_cast<double>(frame.depth.at(7, y)));
  }
}

}  // namespace
}  // namespace pullfocus::cli::preview
