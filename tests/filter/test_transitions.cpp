// Shots whose frames change in kind: opaque and transparent, half and float.
#include <gtest/gtest.h>

#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::for_each_in;
using test::options_up_to;

constexpr CocFunction lens{DepthKind::planar, 8, 0.5f};  // focused at 2; 4 px at infinity

TEST(Transitions, AnOpaqueAlphaComesOutAsExactly1) {
  const Window window{0, 0, 66, 40};
  test::RandomShot shot(window, 9, SampleType::half, false, true);
  const auto filter = make_incremental_filter(window, options_up_to(30));
  for (int frame = 0; frame < 5; ++frame) {
    filter->filter(shot.step(), test::random_lens(shot.random(), 30));
    for_each_in(window, [&](int x, int y) { ASSERT_EQ(filter->result().get(x, y, 3), 1.f); });
  }
}

TEST(Transitions, FramesThatTurnTransparentAndBackEqualAFreshFilter) {
  const Window window{0, 0, 66, 40};
  const CocFunction coc{DepthKind::planar, 15, 0.4f};
  const auto used = make_incremental_filter(window, options_up_to(30));
  test::RandomShot opaque(window, 2, SampleType::half, false, false);
  test::RandomShot transparent(window, 2, SampleType::half, true, false);
  for (const bool is_opaque : {true, false, false, true, true, false}) {
    const Frame& frame = (is_opaque ? opaque : transparent).step();
    const auto fresh = make_incremental_filter(window, options_up_to(30));
    used->filter(frame, coc);
    fresh->filter(frame, coc);
    ASSERT_EQ(test::difference(used->result(), fresh->result()), "");
    if (is_opaque) {
      for_each_in(window, [&](int x, int y) { ASSERT_EQ(used->result().get(x, y, 3), 1.f); });
    }
  }
}

// The picture changes its type although no pixel changed.
TEST(Transitions, TheSameFrameAsHalfAndAsFloatGivesTheSamePicture) {
  const Window window{0, 0, 40, 25};
  FilterOptions options;
  options.kernel.max_coc_px = 16;
  test::RandomShot shot(window, 3, SampleType::half, true, false);
  const auto linear = make_linear_filter(window, options), incremental = make_incremental_filter(window, options);
  for (const SampleType type : {SampleType::half, SampleType::float32, SampleType::half}) {
    shot.use_type(type);
    const Stats& stats = incremental->filter(shot.frame(), lens);
    linear->filter(shot.frame(), lens);
    EXPECT_EQ(incremental->result().type(), type);
    EXPECT_EQ(test::difference(incremental->result(), linear->result()), "");
    EXPECT_EQ(stats.resolved, 1000);
  }
}

}  // namespace
}  // namespace pullfocus
