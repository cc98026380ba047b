// Premultiplied pictures with antialiased or motion-blurred alpha, composited after filtering: no rims.
//
// A rim is measured in three ways, over any plain colour K:
//   identity   over(filter(picture), K) against filter(over(picture, K)): both are the same sum, since K is constant
//   overshoot  how far the composite leaves the range that the foreground, what lies behind it and K span
//   loss       1 - alpha where all that an opaque surface's own blur can reach is opaque: there K must not shine
//   through
// Weights that depend on alpha, or colours divided by it, break the first two at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "filter/incremental_filter.h"
#include "plain_frames.h"

namespace pullfocus {
namespace {

using Colour = std::array<double, 3>;

constexpr Window window{0, 0, 90, 70};
constexpr Colour kBlack{0, 0, 0}, kWhite{1, 1, 1}, kRed{1, 0, 0}, kDisc{6, 3.5, 0.25}, kWall{0.2, 0.4, 0.7};

// Shares of the pixels that a disc covers; `shutter` pixels of motion to the right blur it.
double coverage(int x, int y, double shutter) {
  constexpr int n = 8;
  int inside = 0;
  for (int i = 0; i < n * n; ++i) {
    const double u = x + (i % n + 0.5) / n - 45 - shutter * ((i * 37 % 64) / 63. - 0.5), v = y + (i / n + 0.5) / n - 35;
    inside += u * u + v * v < 20 * 20;
  }
  return static_cast<double>(inside) / (n * n);
}

struct Shot {
  double wall_alpha;       // 0: the disc floats over nothing
  double shutter;          // px
  float disc_px, wall_px;  // CoC
};

// The disc before the wall, `seen_through` behind both where their alpha leaves room. Depth is the first hit's.
Frame render(const Shot& shot, SampleType type, const Colour* seen_through) {
  Frame frame{ColourImage(window, type), Plane(window, shot.wall_px)};
  test::for_each_in(window, [&](int x, int y) {
    const double share = coverage(x, y, shot.shutter);
    const double alpha = share + (1 - share) * shot.wall_alpha;
    for (int c = 0; c < 3; ++c) {
      double value = share * kDisc[c] + (1 - share) * shot.wall_alpha * kWall[c];
      if (seen_through) value += (1 - alpha) * (*seen_through)[c];
      frame.colour.set(x, y, c, static_cast<float>(value));
    }
    frame.colour.set(x, y, 3, seen_through ? 1.f : static_cast<float>(alpha));
    if (share > 0) frame.depth.at(x, y) = shot.disc_px;
  });
  return frame;
}

ColourImage filtered(const Frame& frame, const FilterOptions& options) {
  IncrementalFilter filter(window, options);
  filter.filter(frame, test::coc_as_depth);
  return filter.result();
}

double over(const ColourImage& image, int x, int y, int c, const Colour& k) {
  return static_cast<double>(image.get(x, y, c)) + (1 - static_cast<double>(image.get(x, y, 3))) * k[c];
}

class TransparentEdges : public testing::TestWithParam<Shot> {};

TEST_P(TransparentEdges, FilteringAndCompositingOverAnyColourMayChangePlaces) {
  for (const Colour& k : {kBlack, kWhite, kRed}) {
    const ColourImage picture = filtered(render(GetParam(), SampleType::float32, nullptr), test::options_up_to(30));
    const ColourImage composite = filtered(render(GetParam(), SampleType::float32, &k), test::options_up_to(30));
    test::for_each_in(window, [&](int x, int y) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(over(picture, x, y, c, k), composite.get(x, y, c), 3e-6) << x << "," << y;
    });
  }
}

TEST_P(TransparentEdges, NoCompositeLeavesTheRangeOfWhatItIsMadeOf) {
  for (const SampleType type : {SampleType::half, SampleType::float32}) {
    FilterOptions options = test::options_up_to(30);
    options.output_type = type;
    const ColourImage picture = filtered(render(GetParam(), type, nullptr), options);
    // Two roundings of a half, of colour and of alpha, in and out; 1 ulp is 2^-11 of the value.
    const double tolerance = type == SampleType::half ? 4 * 6. / 2048 : 3e-6;
    for (const Colour& k : {kBlack, kWhite, kRed}) {
      test::for_each_in(window, [&](int x, int y) {
        for (int c = 0; c < 3; ++c) {
          const double behind = GetParam().wall_alpha * kWall[c] + (1 - GetParam().wall_alpha) * k[c];
          const double value = over(picture, x, y, c, k);
          ASSERT_GE(value, std::min({kDisc[c], behind}) - tolerance) << x << "," << y;
          ASSERT_LE(value, std::max({kDisc[c], behind}) + tolerance) << x << "," << y;
        }
      });
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Discs, TransparentEdges,
                         testing::Values(Shot{0, 0, 0, 12}, Shot{0, 0, 9, 0}, Shot{0, 0, -14, 6}, Shot{0, 12, 0, 8},
                                         Shot{0, 12, -10, 4}, Shot{0.6, 0, 0, 12}, Shot{0.6, 12, -9, 3},
                                         Shot{1, 0, 0, 10}, Shot{1, 12, 8, 0}));

// A ball over blurred nothing, its diameters from `rim` to `rim + front` in steps as of half depth.
double largest_loss(const char* visibility, float rim, float front) {
  Frame frame{ColourImage(window, SampleType::float32), Plane(window, 40)};
  const auto distance = [](int x, int y) { return std::hypot(x - 44.5, y - 34.5); };
  constexpr double radius = 30;
  test::for_each_in(window, [&](int x, int y) {
    const double d = distance(x, y);
    if (d >= radius) return;
    for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, 1);
    const double height = std::sqrt(1 - d * d / (radius * radius));
    frame.depth.at(x, y) = std::round((rim + front * static_cast<float>(height)) * 12) / 12;
  });
  FilterOptions options = test::options_up_to(40);
  options.visibility = parse_visibility(visibility);
  const ColourImage result = filtered(frame, options);
  const double reach = std::max(std::fabs(rim), std::fabs(rim + front)) / 2 + 2;
  double most = 0;
  test::for_each_in(window, [&](int x, int y) {
    if (distance(x, y) < radius - reach) most = std::max(most, 1 - static_cast<double>(result.get(x, y, 3)));
  });
  return most;
}

TEST(OpaqueBall, BlurredNothingDoesNotShineThroughAnOpaqueBallOfAnotherLayer) {
  EXPECT_EQ(largest_loss("layers", 0, -15), 0);    // focus at the rim
  EXPECT_EQ(largest_loss("layers", 1.5, -12), 0);  // behind it
  // In the layer of what lies behind, and without layers, it does; a border between the two helps.
  EXPECT_GT(largest_loss("none", 0, -15), 0.2);
  EXPECT_GT(largest_loss("layers", 15, -15), 0.2);
  EXPECT_LT(largest_loss("layers:-2,2,30", 15, -15), 0.08);
}

}  // namespace
}  // namespace pullfocus
