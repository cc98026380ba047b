// The result window: the part of the picture that can differ from zero.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "plain_frames.h"

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

// `content` with one colour and one CoC diameter, nothing else.
Frame with_content(const Window& content, float diameter, const Window& window = state) {
  Frame frame = empty_frame(window, half, DepthKind::coc);
  for_each_in(content, [&](int x, int y) {
    test::set_colour(frame.colour, x, y, {1, 0.5f, 0.25f, 1});
    frame.depth.at(x, y) = diameter;
  });
  return frame;
}

void expect_zero_outside(const ColourImage& image, const Window& window) {
  for_each_in(image.window(), [&](int x, int y) {
    if (window.contains(x, y)) return;
    for (int c = 0; c < 4; ++c) ASSERT_EQ(image.get(x, y, c), 0.f) << x << "," << y << " channel " << c;
  });
}

TEST(ResultWindow, IsContentGrownByItsKernelAndCutToTheStateWindow) {
  FilterOptions options = options_up_to(40);
  options.kernel.pixel_aspect = 1.5;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto linear = make_linear_filter(state, options, kernels);
  const auto incremental = make_incremental_filter(state, options, kernels);
  for (const Window& content : {Window{20, 30, 21, 31}, {-12, 7, -11, 8}, {59, 54, 60, 55}, {0, 10, 30, 50}, state}) {
    for (const float d : {0.f, 1.f, -7.f, 40.f}) {
      const Kernel& kernel = kernels->kernel(kernels->coc().index(d));
      const Window expected = intersect(state, grow(content, kernel.radius_x, kernel.radius_y));
      for (Filter* filter : {linear.get(), incremental.get()}) {
        filter->filter(with_content(content, d), coc_as_depth);
        ASSERT_EQ(filter->result_window(), expected) << d << " px";
        expect_zero_outside(filter->result(), expected);
        ASSERT_FALSE(HasFailure()) << d << " px";
      }
    }
  }
}

TEST(ResultWindow, HoldsAllOfThePictureForRandomContent) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  for (const double aspect : {1., 0.5, 2.}) {
    FilterOptions options = options_up_to(25);
    options.kernel.pixel_aspect = aspect;
    const auto filter = make_incremental_filter(state, options);
    for (int round = 0; round < 20; ++round) {
      Frame frame = empty_frame(state, half, DepthKind::coc);
      for (int i = below(5); i >= 0; --i) {
        const int x = state.x0 + below(state.width()), y = state.y0 + below(state.height());
        test::set_colour(frame.colour, x, y, {1, 0, below(2) ? 1.f : 0.f, 1});
        frame.depth.at(x, y) = static_cast<float>(below(500) - 250) / 10;
      }
      filter->filter(frame, coc_as_depth);
      expect_zero_outside(filter->result(), filter->result_window());
    }
  }
}

// Where pixels are not square, a larger disc can end a row earlier than a smaller one.
TEST(ResultWindow, HoldsThePictureOfTheWidestKernelWhateverThePixelAspect) {
  const Window window{0, 0, 130, 130};
  for (const double aspect : {0.12, 0.2, 0.3, 0.4, 0.6, 0.9, 1., 16. / 15, 1.2, 1.8}) {
    for (const double max_coc : {12., 16., 20., 24., 32., 39., 64.}) {
      FilterOptions options = options_up_to(max_coc);
      options.kernel.pixel_aspect = aspect;
      options.kernel.coc_step = 0;
      const auto kernels = std::make_shared<const KernelTable>(options.kernel);
      const auto filter = make_linear_filter(window, options, kernels);
      Frame frame = empty_frame(window, half, DepthKind::coc);
      for (int i = 0; i < kernels->coc().size() && i < window.width(); ++i) {
        const int x = i % 2 ? i / 2 : window.width() - 1 - i / 2;
        test::set_colour(frame.colour, x, 65, {1, 1, 1, 1});
        frame.depth.at(x, 65) = static_cast<float>(kernels->coc().diameter(i));
      }
      filter->filter(frame, coc_as_depth);
      expect_zero_outside(filter->result(), filter->result_window());
      ASSERT_FALSE(HasFailure()) << "aspect " << aspect << " to " << max_coc << " px";
    }
  }
}

TEST(ResultWindow, GrowsByTheWidestKernelEvenDeepInsideTheContent) {
  const auto kernels = std::make_shared<const KernelTable>(options_up_to(40).kernel);
  const auto filter = make_linear_filter(state, options_up_to(40), kernels);
  const Window content{state.x0, 28, state.x1, 44};
  const int radius = kernels->kernel(kernels->coc().index(20)).radius_x;
  for_each_in({state.x0 + 1, 29, state.x1 - 1, 43}, [&](int x, int y) {
    if (x % 7 != 0 || y % 3 != 0) return;
    Frame frame = with_content(content, 2);
    frame.depth.at(x, y) = 20;
    filter->filter(frame, coc_as_depth);
    ASSERT_EQ(filter->result_window(), intersect(state, grow(content, radius, radius))) << x << "," << y;
  });
}

TEST(ResultWindow, HoldsAlphaAndSurfacesWithoutColour) {
  const auto filter = make_linear_filter(state, options_up_to(10));
  Frame frame = empty_frame(state, half);
  frame.colour.set(3, 20, 3, 0.5f);
  frame.depth.at(9, 30) = 2;
  filter->filter(frame, {DepthKind::planar, 1e-3f, 0.5f});
  EXPECT_EQ(filter->result_window(), (Window{3, 20, 10, 31}));
}

// Alpha is 1 everywhere then, and says nothing about content.
TEST(ResultWindow, OfAFrameWithoutAlphaHoldsColour) {
  const auto filter = make_linear_filter(state, options_up_to(10));
  Frame frame = flat_frame(state, half, {0, 0, 0, 1}, infinity);
  frame.has_alpha = false;
  test::set_colour(frame.colour, 3, 20, {0, 0, 1, 1});
  filter->filter(frame, {DepthKind::planar, 1e-3f, 0.5f});
  EXPECT_EQ(filter->result_window(), (Window{3, 20, 4, 21}));
  for_each_in(state, [&](int x, int y) { ASSERT_EQ(filter->result().get(x, y, 2), x == 3 && y == 20); });
}

TEST(ResultWindow, OfAnEmptyFrameIsOnePixel) {
  const Window one{state.x0, state.y0, state.x0 + 1, state.y0 + 1};
  const auto linear = make_linear_filter(state, options_up_to(10));
  const auto incremental = make_incremental_filter(state, options_up_to(10));
  for (Filter* filter : {linear.get(), incremental.get()}) {
    for (int round = 0; round < 2; ++round) {
      filter->filter(empty_frame(state, half), {DepthKind::planar, 10, 1});
      EXPECT_EQ(filter->result_window(), one);
      expect_zero_outside(filter->result(), {});
    }
  }
}

TEST(ResultWindow, DependsOnTheFrameAloneOnceNothingIsLeftOver) {
  const auto filter = make_incremental_filter(state, options_up_to(10));
  filter->filter(with_content({-5, 10, 50, 50}, 9), coc_as_depth);
  filter->filter(with_content({30, 30, 31, 31}, 0), coc_as_depth);
  EXPECT_EQ(filter->result_window(), (Window{30, 30, 31, 31}));
  expect_zero_outside(filter->result(), filter->result_window());
}

TEST(ResultWindow, IsUnitedWithTheOneBeforeAsLongAsSomethingIsLeftOver) {
  FilterOptions options = options_up_to(10);
  options.budget = {Budget::Kind::percent, 60};
  const auto filter = make_incremental_filter(state, options);
  filter->filter(with_content({0, 10, 8, 14}, 0), coc_as_depth);
  EXPECT_EQ(filter->result_window(), (Window{0, 10, 8, 14}));
  const Frame second = with_content({30, 30, 40, 33}, 0);
  while (filter->filter(second, coc_as_depth).left_over > 0) {
    ASSERT_EQ(filter->result_window(), (Window{0, 10, 40, 33}));
    expect_zero_outside(filter->result(), filter->result_window());
  }
  EXPECT_EQ(filter->result_window(), (Window{30, 30, 40, 33}));
}

}  // namespace
}  // namespace pullfocus
