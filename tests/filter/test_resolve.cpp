// Division of accumulators, pixel by pixel.
#include "resolve/resolve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "plain_frames.h"
#include "reference.h"
#include "shapes.h"

namespace pullfocus {
namespace {

const Window window{-2, 5, 6, 9};

Accumulator units(double value) {
  return static_cast<Accumulator>(std::llrint(value * static_cast<double>(kWeightUnit)));
}

TEST(Resolve, DividesEveryLaneByTheWeight) {
  const ColourImage own(window, SampleType::float32);
  const Accumulator values[] = {units(1), units(-3), units(0), units(2),   units(1),  //
                                units(4), units(5),  units(6), units(0.5), units(0.25)};
  ColourImage out(window, SampleType::float32), expected = out;
  test::set_colour(expected, 1, 7, {0.5f, -1.5f, 0, 0.5f});
  test::set_colour(expected, 2, 7, {8, 10, 12, 0.5f});
  resolve_span(values, kAlphaLanes, 3, 5, 2, own, out);
  EXPECT_EQ(test::difference(out, expected), "");
}

TEST(Resolve, WithoutAnAlphaLaneIsOpaque) {
  const ColourImage own(window, SampleType::half);
  const Accumulator values[] = {units(1), units(2), units(3), units(4)};
  ColourImage out(window, SampleType::half), expected = out;
  test::set_colour(expected, 5, 8, {0.25f, 0.5f, 0.75f, 1});
  resolve_span(values, kOpaqueLanes, 7, 8, 3, own, out);
  EXPECT_EQ(test::difference(out, expected), "");
}

TEST(Resolve, OfWeightZeroIsThePixelsOwnColour) {
  for (const SampleType type : {SampleType::half, SampleType::float32}) {
    for (const int lanes : {kOpaqueLanes, kAlphaLanes}) {
      ColourImage own(window, type);
      test::set_colour(own, -1, 6, {0.25f, -2, 3, 0.5f});
      const Accumulator values[kAlphaLanes] = {};
      ColourImage out(window, SampleType::float32);
      resolve_span(values, lanes, 1, 2, 1, own, out);
      EXPECT_EQ(out.get(-1, 6, 0), 0.25f);
      EXPECT_EQ(out.get(-1, 6, 1), -2.f);
      EXPECT_EQ(out.get(-1, 6, 2), 3.f);
      EXPECT_EQ(out.get(-1, 6, 3), 0.5f);
    }
  }
}

// A ring of light around each blurred pixel, and none on itself; all others are sharp.
TEST(Resolve, OfWeightZeroIsTheColourThatAnUpdateHasJustCommitted) {
  AperturePicture ring{9, 9, std::vector<float>(81, 1)};
  for (std::size_t y = 1; y < 8; ++y) std::fill_n(&ring.luminance[9 * y + 1], 7, 0.f);
  FilterOptions options = test::options_up_to(9);
  options.kernel.shape = test::of_kind(KernelShape::Kind::image);
  options.kernel.shape.picture = std::make_shared<AperturePicture>(ring);
  const Window wide{0, 0, 200, 40};
  const Window blurred{31, 8, 34, 11};
  for (const auto kind : {VisibilityOptions::Kind::none, VisibilityOptions::Kind::layers}) {
    options.visibility.kind = kind;
    Frame frame = test::flat_frame(wide, SampleType::float32, {1, 2, 3}, 0);
    test::for_each_in(blurred, [&](int x, int y) { frame.depth.at(x, y) = 9; });
    const auto incremental = make_incremental_filter(wide, options), linear = make_linear_filter(wide, options);
    incremental->filter(frame, test::coc_as_depth);
    for (const float red : {4.f, 0.5f}) {
      test::for_each_in(blurred, [&](int x, int y) { frame.colour.set(x, y, 0, red); });
      const Stats& stats = incremental->filter(frame, test::coc_as_depth);
      linear->filter(frame, test::coc_as_depth);
      ASSERT_EQ(stats.mode, ScatterMode::incremental);
      EXPECT_EQ(incremental->result().get(32, 9, 0), red) << "shows itself";
      EXPECT_EQ(test::difference(incremental->result(), linear->result()), "");
    }
  }
}

TEST(Resolve, ClampsHalvesWhereverTheyComeFrom) {
  ColourImage own(window, SampleType::float32), out(window, SampleType::half);
  test::set_colour(own, -2, 5, {1e6f, -1e6f, 65519.f, 1});
  const Accumulator values[] = {units(0), units(0), units(0), units(0), units(1e5), units(-1e5), units(0), units(1)};
  resolve_span(values, kOpaqueLanes, 0, 2, 0, own, out);
  for (const int x : {-2, -1}) {
    EXPECT_EQ(out.get(x, 5, 0), 65504.f);
    EXPECT_EQ(out.get(x, 5, 1), -65504.f);
  }
  EXPECT_EQ(out.get(-2, 5, 2), 65504.f);
}

}  // namespace
}  // namespace pullfocus
