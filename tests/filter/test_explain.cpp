// explain() tells of a pixel what the filter did.
#include "filter/explain.h"

#include <gtest/gtest.h>

#include "filter/linear_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "shapes.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::for_each_in;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

TEST(Explain, SharesTimesColoursAreTheResultForEveryKernelAndVisibility) {
  const std::vector<KernelShape> shapes = test::all_shapes();
  for (unsigned seed = 0; seed < 3 * shapes.size(); ++seed) {
    const Window window{-4, 3, 19, 20};
    test::RandomShot shot(window, seed, SampleType::float32, true, false);
    FilterOptions options = test::options_up_to(14);
    options.kernel.shape = shapes[seed % shapes.size()];
    options.visibility.kind = static_cast<VisibilityOptions::Kind>(seed / shapes.size());
    options.visibility.borders = {-4, -1, 0, 3};
    options.visibility.bitmap_size = 8;
    LinearFilter filter(window, options);
    const CocFunction coc = test::random_lens(shot.random(), 14);
    filter.filter(shot.frame(), coc);
    const KernelTable kernels(options.kernel);
    for_each_in(window, [&](int x, int y) {
      const Explanation story = explain(shot.frame(), coc, kernels, x, y, kAll, options.visibility);
      if (story.filled_share == 0) {
        ASSERT_EQ(story.contributors, static_cast<std::int64_t>(story.largest.size()));
      }
      ASSERT_GT(story.contributors, 0);
      double shares = 0, layers = story.filled_share;
      double colour[4] = {}, size[4] = {};
      for (const Contributor& c : story.largest) {
        shares += c.share;
        for (int i = 0; i < 4; ++i) {
          const double part = c.share * static_cast<double>(shot.frame().colour.get(c.x, c.y, i));
          colour[i] += part;
          size[i] += std::fabs(part);
        }
      }
      for (const LayerShare& layer : story.layers) layers += layer.share;
      ASSERT_NEAR(shares, 1, 1e-9);
      ASSERT_NEAR(layers, 1, 1e-9);
      for (int i = 0; i < 4; ++i) {
        ASSERT_NEAR(static_cast<double>(filter.result().get(x, y, i)), colour[i], 1e-6 * (1 + size[i]))
            << describe(options.visibility) << ", " << describe(options.kernel.shape) << ", seed " << seed << " at "
            << x << "," << y;
      }
    });
  }
}

TEST(Explain, NamesTheLayerThatHidesAnother) {
  const Window window{0, 0, 21, 9};
  Frame frame = test::flat_frame(window, SampleType::half, {1, 1, 1}, 10);  // blurred, behind
  for_each_in({8, 0, 13, 9}, [&](int x, int y) { frame.depth.at(x, y) = 0; });
  const KernelTable kernels(test::options_up_to(12).kernel);
  const Explanation story = explain(frame, coc_as_depth, kernels, 10, 4, 1, VisibilityOptions{});
  ASSERT_EQ(story.layers.size(), 2u);
  EXPECT_EQ(story.layers[0].coc_first, -2);
  EXPECT_EQ(story.layers[0].coc_last, 2);
  EXPECT_EQ(story.layers[0].share, 1);
  EXPECT_GT(story.layers[1].weight, 0.1);
  EXPECT_EQ(story.layers[1].share, 0);
  EXPECT_EQ(story.own_share, 1);
  EXPECT_EQ(story.largest[0].layer, 1);  // 0 is in front of focus and has no sources
}

}  // namespace
}  // namespace pullfocus
