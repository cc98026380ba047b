// Antialiased depth is found and repaired; what is invalid is left as it is.
#include "camera/depth_repair.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <set>
#include <string>

#include "depth_scenes.h"

namespace pullfocus {
namespace {

using namespace test;

TEST(DepthRepair, BringsTheCocOfABoxFilteredShotBackToThatOfTheCleanOne) {
  for (const double size : {1., 1.5, 2.}) {
    double before = 0, after = 0, least = 1;
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const Frame truth = clean(window, cards(seed));
      Frame frame = box_filtered(window, cards(seed), size);
      const DepthEdges found = find_depth_edges(frame, DepthKind::planar);
      EXPECT_TRUE(found.look_antialiased()) << found.mixed << " of " << found.mixed + found.sharp;
      EXPECT_FALSE(find_depth_edges(truth, DepthKind::planar).look_antialiased());
      least = std::min(least, found.share());
      before += coc_error(frame, truth, lens);
      EXPECT_GT(repair_depth(frame, DepthKind::planar), 0);
      EXPECT_LT(find_depth_edges(frame, DepthKind::planar).share(), 0.02);
      after += coc_error(frame, truth, lens);
    }
    EXPECT_LT(after, 0.3 * before) << "box of " << size << " px";
    RecordProperty("error_left_box_" + std::to_string(size), std::to_string(after / before));
    RecordProperty("least_share_of_mixed_box_" + std::to_string(size), std::to_string(least));
  }
}

TEST(DepthRepair, IsIdempotent) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double size : {1., 2., 3.}) {
      Frame frame = box_filtered(window, cards(seed), size);
      repair_depth(frame, DepthKind::planar);
      const Frame once = frame;
      EXPECT_EQ(repair_depth(frame, DepthKind::planar), 0);
      EXPECT_EQ(differing(frame, once), 0);
    }
  }
}

TEST(DepthRepair, TakesEveryDepthFromAnotherPixelOfTheFrame) {
  const Frame before = box_filtered(window, cards(3), 1);
  Frame after = before;
  repair_depth(after, DepthKind::planar);
  const std::set<float> stored(before.depth.row(window.y0), before.depth.row(window.y0) + window.pixels());
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) ASSERT_TRUE(stored.contains(after.depth.at(x, y))) << x << "," << y;
  }
}

TEST(DepthRepair, HandlesInvalidAndInfiniteDepthsAndTakesNoneOfThem) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    Frame frame = box_filtered(window, cards(static_cast<unsigned>(round)), 1);
    const float odd[] = {nan, infinity, -infinity, -3.f, 1e10f, 0.f, 1e-42f};
    for (int i = 0; i < 700; ++i) {
      frame.depth.at(window.x0 + static_cast<int>(random() % 96), window.y0 + static_cast<int>(random() % 80)) =
          odd[random() % 7];
    }
    const Frame before = frame;
    repair_depth(frame, DepthKind::planar);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const float was = before.depth.at(x, y), is = frame.depth.at(x, y);
        const bool invalid = !std::isfinite(was) || was < 0;
        if (invalid) {
          ASSERT_EQ(std::memcmp(&was, &is, sizeof is), 0) << was << " became " << is;
        } else {
          ASSERT_TRUE(std::isfinite(is) && is >= 0);
        }
      }
    }
  }
}

// A disc over nothing: depth filtered with the empty pixels' value, alpha filtered alike.
TEST(DepthRepair, GivesTransparentEdgesOverEmptyPixelsTheDepthOfTheirSurface) {
  for (const double empty : {0., 1e10}) {
    const auto inside = [](double x, double y) { return (x - 40) * (x - 40) + (y - 45) * (y - 45) < 900; };
    const DepthAt depth = [&](double x, double y) { return inside(x, y) ? 4. : empty; };
    Frame frame = box_filtered(window, depth, 1);
    const Frame alpha = box_filtered(
        window, [&](double x, double y) { return inside(x, y) ? 1. : 0.; }, 1);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) frame.colour.set(x, y, 3, alpha.depth.at(x, y));
    }
    EXPECT_TRUE(find_depth_edges(frame, DepthKind::planar).look_antialiased());
    EXPECT_GT(repair_depth(frame, DepthKind::planar), 50);
    int still_mixed = 0, wrong = 0;
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const float a = alpha.depth.at(x, y), z = frame.depth.at(x, y);
        const bool of_disc = std::fabs(z - 4) < 0.07f, of_nothing = is_background(DepthKind::planar, z);
        still_mixed += !of_disc && !of_nothing;
        wrong += a > 1.f / 8 && a < 7.f / 8 && !of_disc;
      }
    }
    EXPECT_EQ(wrong, 0) << "empty is " << empty;
    EXPECT_EQ(still_mixed, 0) << "empty is " << empty;
  }
}

TEST(DepthRepair, LeavesATransparentPixelAloneWhoseDepthIsNoMixtureByItsAlpha) {
  for (const float alpha : {0.2f, 0.45f, 0.55f, 0.8f}) {
    Frame frame = clean(window, [](double x, double) { return x < 40 ? 0. : x < 41 ? 2. : 4.; });
    for (int y = window.y0; y < window.y1; ++y) frame.colour.set(40, y, 3, alpha);
    EXPECT_EQ(repair_depth(frame, DepthKind::planar), std::fabs(alpha - 0.5f) < 0.1f ? window.height() : 0) << alpha;
  }
}

TEST(DepthRepair, SnapsDiametersOfKindCocToo) {
  const DepthAt step = [](double x, double) { return x < 40.3 ? -6. : 9.; };
  Frame frame = box_filtered(window, step, 1);
  EXPECT_EQ(repair_depth(frame, DepthKind::coc), window.height());
  EXPECT_EQ(differing(frame, clean(window, [](double x, double) { return x < 40 ? -6. : 9.; })), 0);
  Frame slope = clean(window, [](double x, double y) { return 0.7 * x - 0.4 * y; });
  EXPECT_EQ(repair_depth(slope, DepthKind::coc), 0);
}

TEST(DepthRepair, IsTheSameForAnyNumberOfThreadsAndAnySize) {
  for (const int width : {1, 2, 3, 5, 17, 64, 65}) {
    for (const int height : {1, 2, 4, 7, 33}) {
      const Window odd{7, -2, 7 + width, -2 + height};
      const Frame before = box_filtered(odd, cards(static_cast<unsigned>(width * height)), 1);
      Frame one = before, four = before;
      DepthEdges of_one, of_four;
      tbb::task_arena(1).execute([&] {
        of_one = find_depth_edges(one, DepthKind::planar);
        repair_depth(one, DepthKind::planar);
      });
      tbb::task_arena(4).execute([&] {
        of_four = find_depth_edges(four, DepthKind::planar);
        repair_depth(four, DepthKind::planar);
      });
      EXPECT_EQ(differing(one, four), 0);
      EXPECT_EQ(of_one.mixed, of_four.mixed);
      EXPECT_EQ(of_one.sharp, of_four.sharp);
    }
  }
}

}  // namespace
}  // namespace pullfocus
