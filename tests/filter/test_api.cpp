// A program's view: the umbrella header alone suffices, as the README shows.
#include <gtest/gtest.h>

#include "pullfocus.h"

namespace pullfocus {
namespace {

TEST(Api, TheUmbrellaHeaderIsAllAProgramNeeds) {
  const Window window{0, 0, 64, 48};
  Frame frame;
  frame.colour.reset(window, SampleType::float32);
  frame.depth.reset(window, 3.f);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, c == 3 || x == 20 ? 1.f : 0.f);
    }
  }
  ThinLens lens;
  lens.focal_length_mm = 50;
  lens.f_number = 2;
  lens.focus_distance = 3;
  const Raster raster{64, 48};

  FilterOptions options;
  const auto filter = make_incremental_filter(window, options);
  filter->filter(frame, coc_function(lens, raster, DepthKind::planar));
  EXPECT_EQ(filter->result().get(20, 10, 0), 1);
  EXPECT_EQ(filter->result().get(21, 10, 0), 0);

  lens.focus_distance = 1;
  const Stats& stats = filter->filter(frame, coc_function(lens, raster, DepthKind::planar));
  EXPECT_EQ(stats.updated, 64 * 48);
  EXPECT_GT(filter->result().get(21, 10, 0), 0);  // a CoC of 1.5 px
  EXPECT_EQ(filter->filter(frame, coc_function(lens, raster, DepthKind::planar)).mode, ScatterMode::unchanged);
}

TEST(Api, ACallThatIsStoppedGoesOnInTheNext) {
  const Window window{0, 0, 64, 48};
  Frame frame;
  frame.colour.reset(window, SampleType::half);
  frame.depth.reset(window, 2.f);
  FilterOptions options;
  options.slice_edges = 100;
  const auto filter = make_incremental_filter(window, options);
  const CocFunction coc{DepthKind::coc, 1, 0};
  int slices = 3;
  EXPECT_GT(filter->filter(frame, coc, [&] { return slices-- == 0; }).left_over, 0);
  EXPECT_EQ(filter->filter(frame, coc).left_over, 0);
}

TEST(Api, ExplainAndPlanAgreeWithTheFrame) {
  const Window window{0, 0, 20, 20};
  Frame frame;
  frame.colour.reset(window, SampleType::half);
  frame.depth.reset(window, 6.f);
  const CocFunction coc{DepthKind::coc, 1, 0};
  const FilterOptions options;
  const KernelTable kernels(options.kernel);
  const Explanation story = explain(frame, coc, kernels, 10, 10, 5);
  EXPECT_EQ(story.coc_px, 6);
  EXPECT_EQ(story.diameter_px, 6);
  EXPECT_NEAR(story.total_weight, 1, 1e-7);
  EXPECT_EQ(story.largest.size(), 5u);
  EXPECT_GE(story.largest[0].share, story.largest[4].share);
  // At a corner, what is mirrored back belongs to the pixel too.
  EXPECT_NEAR(explain(frame, coc, kernels, 0, 19, 1).total_weight, 1, 1e-7);

  Frame next = frame;
  next.depth.at(3, 4) = 5;
  const Plan plan = make_plan(options, kernels, frame, coc, &next, coc);
  EXPECT_EQ(plan.coc_min, 6);
  EXPECT_EQ(plan.coc_max, 6);
  EXPECT_EQ(plan.linear_edges, 400 * kernels.kernel(kernels.coc().index(6)).edge_count());
  EXPECT_DOUBLE_EQ(plan.changed_share.value(), 1. / 400);
  EXPECT_EQ(plan.next_edges,
            kernels.kernel(kernels.coc().index(6)).edge_count() + kernels.kernel(kernels.coc().index(5)).edge_count());
}

}  // namespace
}  // namespace pullfocus
