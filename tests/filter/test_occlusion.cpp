// What occlusion bitmaps hide, seen from outside; and that their options are checked.
#include "scatter/occlusion.h"

#include <gtest/gtest.h>

#include "filter/explain.h"
#include "filter/incremental_filter.h"
#include "filter/plan.h"
#include "image/error.h"
#include "plain_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;

FilterOptions bitmaps(double max_coc_px, int size = 32) {
  FilterOptions options = test::options_up_to(max_coc_px);
  options.visibility = {VisibilityOptions::Kind::bitmap, {}, size, 3};
  return options;
}

// A dark sharp band in front of a bright blurred background, or the other way round.
Frame band_frame(const Window& window, const Window& band, float band_coc, float background_coc, float band_colour,
                 float background_colour) {
  Frame frame = test::flat_frame(window, SampleType::float32, {background_colour, background_colour, background_colour},
                                 background_coc);
  test::for_each_in(band, [&](int x, int y) {
    test::set_colour(frame.colour, x, y, {band_colour, band_colour, band_colour});
    frame.depth.at(x, y) = band_coc;
  });
  return frame;
}

float brightest(const ColourImage& image, const Window& part) {
  float most = 0;
  test::for_each_in(part, [&](int x, int y) { most = std::max(most, image.get(x, y, 0)); });
  return most;
}

TEST(Occlusion, ADarkSharpBandBeforeABrightBlurredBackgroundStaysDark) {  // Fearing 1996, figure 5
  const Window window{0, 0, 96, 64};
  for (const Window& band : {Window{44, 0, 52, 64}, Window{0, 0, 9, 64}, Window{87, 0, 96, 64}, Window{0, 0, 96, 6},
                             Window{0, 58, 96, 64}, Window{40, 20, 41, 40}}) {
    const Frame frame = band_frame(window, band, 0, 24, 0, 1);
    const auto plain = make_linear_filter(window, test::options_up_to(24));
    const auto filter = make_linear_filter(window, bitmaps(24));
    plain->filter(frame, coc_as_depth);
    filter->filter(frame, coc_as_depth);
    EXPECT_GT(brightest(plain->result(), band), 0.2f);
    EXPECT_LT(brightest(filter->result(), band), 0.01f);
  }
}

TEST(Occlusion, ANearBlurredBandStillCoversWhatIsBehind) {
  const Window window{0, 0, 96, 64}, band{40, 0, 56, 64};
  const Frame frame = band_frame(window, band, -24, 0, 1, 0);
  const auto filter = make_linear_filter(window, bitmaps(24));
  filter->filter(frame, coc_as_depth);
  EXPECT_GT(filter->result().get(38, 32, 0), 0.05f);
  EXPECT_GT(filter->result().get(57, 32, 0), 0.05f);
}

TEST(Occlusion, EqualDepthsAndDiametersWithinTheCutoffHideNothing) {
  const Window window{0, 0, 64, 40}, band{20, 0, 40, 40};
  const auto same = [&](const Frame& frame, const CocFunction& coc) {
    const auto plain = make_linear_filter(window, test::options_up_to(30));
    const auto filter = make_linear_filter(window, bitmaps(30));
    plain->filter(frame, coc);
    filter->filter(frame, coc);
    return test::difference(plain->result(), filter->result()).empty();
  };
  EXPECT_TRUE(same(band_frame(window, band, 4, 7, 0, 1), coc_as_depth));
  EXPECT_FALSE(same(band_frame(window, band, 4, 7.5f, 0, 1), coc_as_depth));
  EXPECT_TRUE(same(band_frame(window, band, 9, 9, 0, 1), coc_as_depth));
}

TEST(Occlusion, ReachesAsFarAsTheWindowAndNoFarther) {
  const Window window{0, 0, 80, 61};
  for (const int size : {2, 8, 16}) {
    // One far pixel lights near, sharp, black ones; light at offsets -size/2 .. size/2 - 1 is hidden.
    Frame frame = test::flat_frame(window, SampleType::float32, {0, 0, 0}, 0);
    test::set_colour(frame.colour, 40, 30, {1, 1, 1});
    frame.depth.at(40, 30) = 30;
    const auto filter = make_linear_filter(window, bitmaps(30, size));
    filter->filter(frame, coc_as_depth);
    for (int dx = -14; dx <= 14; ++dx) {
      if (dx == 0) continue;
      EXPECT_EQ(filter->result().get(40 + dx, 30, 0) == 0, dx >= -size / 2 && dx < size / 2) << size << " " << dx;
    }
  }
}

TEST(Occlusion, APixelWhoseDepthAloneChangesIsChanged) {
  const Window window{0, 0, 40, 24};
  Frame frame = band_frame(window, {10, 5, 20, 20}, 8, 20, 0.2f, 1);
  IncrementalFilter filter(window, bitmaps(20));
  filter.filter(frame, coc_as_depth);
  frame.depth.at(12, 7) = 8.03f;  // the same table entry
  EXPECT_EQ(filter.filter(frame, coc_as_depth).changed, 1);
  const auto linear = make_linear_filter(window, bitmaps(20));
  linear->filter(frame, coc_as_depth);
  EXPECT_EQ(test::difference(filter.result(), linear->result()), "");
}

TEST(Occlusion, ThePlanCountsTilesThatNeedBitmaps) {
  const Window window{0, 0, 640, 160};
  const Frame frame = band_frame(window, {290, 64, 300, 80}, 0, 24, 0, 1);
  const FilterOptions options = bitmaps(24);
  const KernelTable kernels(options.kernel);
  const Plan plan = make_plan(options, kernels, frame, coc_as_depth, nullptr, coc_as_depth);
  EXPECT_EQ(plan.tiles, 100);
  EXPECT_EQ(plan.bitmap_tiles, 3);  // the band's tile row and one on each side, one tile wide
  EXPECT_EQ(plan.bitmap_pixels, 3 * 3 * 16 * 16);
  const Plan flat = make_plan(options, kernels, test::flat_frame(window, SampleType::half, {1, 1, 1}, 24), coc_as_depth,
                              nullptr, coc_as_depth);
  EXPECT_EQ(flat.bitmap_pixels, 0);
}

TEST(Occlusion, ExplanationsWeighWhatTheFilterSums) {
  const Window window{-3, 2, 29, 19};
  const Frame frame = band_frame(window, {0, 2, 5, 19}, 1, 18, 0.2f, 1);
  IncrementalFilter filter(window, bitmaps(18, 10));
  filter.filter(frame, coc_as_depth);
  const KernelTable kernels(bitmaps(18).kernel);
  test::for_each_in(window, [&](int x, int y) {
    const std::size_t at = static_cast<std::size_t>((y - 2) * 32 + x + 3) * static_cast<std::size_t>(filter.lanes());
    const Explanation story = explain(frame, coc_as_depth, kernels, x, y, 1, bitmaps(18, 10).visibility);
    const auto summed = static_cast<double>(filter.accumulators()[at + kWeightLane]) / static_cast<double>(kWeightUnit);
    ASSERT_NEAR(story.total_weight, summed, 1e-12) << x << " " << y;
  });
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Occlusion, OptionsAreReadAndWrongOnesNamed) {
  EXPECT_EQ(parse_visibility("none").kind, VisibilityOptions::Kind::none);
  EXPECT_EQ(parse_visibility("bitmap").bitmap_size, 32);
  EXPECT_EQ(parse_visibility("bitmap:64").bitmap_size, 64);
  for (const char* text :
       {"", "bit", "bitmap:", "bitmap:x", "bitmap:31", "bitmap:0", "bitmap:66", "bitmap:8x", "layer"}) {
    EXPECT_NE(message_of([&] { parse_visibility(text); }).find("--visibility"), std::string::npos) << text;
  }
  for (const double cutoff : {-1., static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    EXPECT_NE(message_of([&] {
                validate(VisibilityOptions{VisibilityOptions::Kind::bitmap, {}, 32, cutoff});
              }).find("--cutoff"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace pullfocus
