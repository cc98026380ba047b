// The state window: fixed from the first frame to the last, wherever the data lie inside it.
#include <gtest/gtest.h>

#include <limits>

#include "camera/usage.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::empty_frame;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

constexpr auto half = SampleType::half;
constexpr float infinity = std::numeric_limits<float>::infinity();
const Window state{-12, 7, 60, 55};

// Inside one state window, it makes no difference how a pixel says that it is empty.
TEST(StateWindow, EmptyMarginsInAnyDisguiseChangeNothing) {
  test::RandomShot shot(state, 4, SampleType::float32, true, false);
  const Window data{0, 20, 41, 44};
  const CocFunction coc{DepthKind::planar, 20, 0.4f};
  Frame cropped = shot.frame();
  for_each_in(state, [&](int x, int y) {
    if (data.contains(x, y)) return;
    test::set_colour(cropped.colour, x, y, {0, 0, 0, 0});
    cropped.depth.at(x, y) = infinity;
  });
  const auto filter = make_linear_filter(state, options_up_to(12));
  filter->filter(cropped, coc);
  const ColourImage expected = filter->result();
  const Window expected_window = filter->result_window();
  for (const float empty : {0.f, 1e9f, 1e10f, 3e38f}) {
    Frame padded = cropped;
    for_each_in(state, [&](int x, int y) {
      if (!data.contains(x, y)) padded.depth.at(x, y) = empty;
    });
    const Stats& stats = filter->filter(padded, coc);
    EXPECT_EQ(stats.repaired_depth, 0);
    EXPECT_EQ(test::difference(filter->result(), expected), "") << empty;
    EXPECT_EQ(filter->result_window(), expected_window);
  }
}

TEST(StateWindow, ItsPlaceInThePlaneDoesNotMatter) {
  test::RandomShot shot({0, 0, 50, 30}, 8, half, true, false);
  const CocFunction coc{DepthKind::planar, 20, 0.4f};
  const auto filter = make_linear_filter(shot.frame().window(), options_up_to(12));
  filter->filter(shot.frame(), coc);
  const Window moved{-1000, 77, -950, 107};
  Frame frame = flat_frame(moved, half, {}, 0);
  for_each_in(moved, [&](int x, int y) {
    frame.depth.at(x, y) = shot.frame().depth.at(x + 1000, y - 77);
    for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, shot.frame().colour.get(x + 1000, y - 77, c));
  });
  const auto filter_of_moved = make_linear_filter(moved, options_up_to(12));
  filter_of_moved->filter(frame, coc);
  for_each_in(moved, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      ASSERT_EQ(filter_of_moved->result().get(x, y, c), filter->result().get(x + 1000, y - 77, c));
    }
  });
}

TEST(StateWindow, GrownByOverscanChangesNothingOutOfReachOfTheOldBorder) {
  test::RandomShot shot(state, 5, half, true, false);
  const CocFunction coc{DepthKind::planar, 20, 0.4f};
  const auto small = make_linear_filter(state, options_up_to(8));
  small->filter(shot.frame(), coc);
  const Window grown = grow(state, 30, 11);
  Frame frame = empty_frame(grown, half);
  for_each_in(state, [&](int x, int y) {
    frame.depth.at(x, y) = shot.frame().depth.at(x, y);
    for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, shot.frame().colour.get(x, y, c));
  });
  const auto large = make_linear_filter(grown, options_up_to(8));
  large->filter(frame, coc);
  const int reach = 5;
  for_each_in(grow(state, -reach, -reach), [&](int x, int y) {
    for (int c = 0; c < 4; ++c) ASSERT_EQ(large->result().get(x, y, c), small->result().get(x, y, c));
  });
}

TEST(StateWindow, FramesOfAnotherWindowAreRefusedAndLeaveTheFilterAsItWas) {
  const auto linear = make_linear_filter(state, options_up_to(10));
  const auto incremental = make_incremental_filter(state, options_up_to(10));
  const Window moved{state.x0 + 1, state.y0, state.x1 + 1, state.y1};
  for (Filter* filter : {linear.get(), incremental.get()}) {
    filter->filter(flat_frame(state, half, {1, 0.5f, 0.25f, 1}, 4), coc_as_depth);
    const ColourImage before = filter->result();
    expect_usage_error([&] { filter->filter(empty_frame(moved, half), coc_as_depth); }, "x -11 .. 60, y 7 .. 54");
    expect_usage_error([&] { filter->filter(empty_frame({0, 0, 1, 1}, half), coc_as_depth); }, "x -12 .. 59");
    Frame odd = empty_frame(state, half);
    odd.depth.reset({0, 0, 1, 1}, 1);
    EXPECT_THROW(filter->filter(odd, coc_as_depth), Error);
    EXPECT_EQ(test::difference(filter->result(), before), "");
  }
}

TEST(StateWindow, MustHaveBetweenOneAnd2ToThe30Pixels) {
  for (const Window& window : {Window{}, {0, 0, 0, 5}, {5, 5, 4, 9}, {0, 0, 1 << 25, 1}, {0, 0, 1 << 20, 1 << 20}}) {
    expect_usage_error([&] { make_linear_filter(window, options_up_to(2)); }, "state window");
    expect_usage_error([&] { make_incremental_filter(window, options_up_to(2)); }, "state window");
  }
}

}  // namespace
}  // namespace pullfocus
