// Depth that no filter mixed is left alone by its repair.
#include "camera/depth_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "depth_scenes.h"

namespace pullfocus {
namespace {

using namespace test;

TEST(DepthRepair, LeavesCleanSilhouettesNearlyAlone) {
  std::int64_t changed = 0, edges = 0;
  double most = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Frame frame = clean(window, cards(seed));
    const DepthEdges found = find_depth_edges(frame, DepthKind::planar);
    edges += found.sharp;
    most = std::max(most, found.share());
    changed += repair_depth(frame, DepthKind::planar);
  }
  RecordProperty("changed", std::to_string(changed));
  RecordProperty("sharp_edges", std::to_string(edges));
  RecordProperty("largest_share_of_mixed", std::to_string(most));
  EXPECT_LT(static_cast<double>(changed), 0.01 * static_cast<double>(edges));
}

TEST(DepthRepair, LeavesPlanesOfAnySlantUntouchedToTheHorizon) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    // Up to half of the nearest inverse depth a pixel; beyond the horizon there is nothing.
    const DepthAt slanted = plane(uniform(0.1, 10), -uniform(0, 0.05), uniform(-0.05, 0.05));
    const DepthAt depth = [&](double x, double y) {
      const double z = slanted(x, y);
      return z > 0 ? z : static_cast<double>(infinity);
    };
    Frame frame = clean(window, depth);
    EXPECT_EQ(repair_depth(frame, DepthKind::planar), 0) << i;
  }
}

TEST(DepthRepair, LeavesSpheresNearlyAloneRightToTheirRims) {
  std::mt19937 random(6);
  std::int64_t changed = 0, edges = 0;
  for (int i = 0; i < 100; ++i) {
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double cx = uniform(20, 70), cy = uniform(20, 70), r = uniform(8, 30), z = uniform(2, 5);
    const double size = uniform(0.2, 1.5), wall = z + uniform(0.1, 10);
    const DepthAt ball = [=](double x, double y) {
      const double d2 = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (r * r);
      return d2 < 1 ? z - size * std::sqrt(1 - d2) : wall;
    };
    Frame frame = clean(window, ball);
    edges += find_depth_edges(frame, DepthKind::planar).sharp;
    changed += repair_depth(frame, DepthKind::planar);
  }
  EXPECT_GT(edges, 2000);
  EXPECT_LT(static_cast<double>(changed), 0.01 * static_cast<double>(edges)) << changed << " of " << edges;
}

}  // namespace
}  // namespace pullfocus
