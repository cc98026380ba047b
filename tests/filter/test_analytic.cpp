// What a filter must give where the answer is known beforehand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;

constexpr auto half = SampleType::half;
constexpr auto float32 = SampleType::float32;

const Window windows[] = {{0, 0, 1, 1}, {0, 0, 2, 1}, {3, -2, 4, 5}, {0, 0, 3, 3}, {-8, 1, 8, 10}, {0, 0, 70, 37}};

// One unit in the last place of a float, or 1e-7, whichever is larger.
double least_error(float value) {
  const float ulp = std::nextafter(std::fabs(value), std::numeric_limits<float>::infinity()) - std::fabs(value);
  return std::max(static_cast<double>(ulp), 1e-7);
}

void expect_flat(const ColourImage& image, const test::Rgba& colour, const std::string& what) {
  const float expected[] = {colour.r, colour.g, colour.b, colour.a};
  for_each_in(image.window(), [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      ASSERT_NEAR(image.get(x, y, c), expected[c], least_error(expected[c])) << what << " at " << x << "," << y;
    }
  });
}

std::shared_ptr<const KernelTable> default_table() {
  static const auto table = std::make_shared<const KernelTable>(KernelOptions{});
  return table;
}

TEST(Analytic, AConstantImageStaysConstantUpToItsBorders) {
  for (const Window& window : windows) {
    const auto filter = make_linear_filter(window, options_up_to(400), default_table());
    for (const float d : {0.f, 0.5f, 1.5f, 3.f, -10.f, 33.3f, 100.f, 400.f}) {
      for (const test::Rgba& colour : {test::Rgba{0.18f, 1.f, 65504.f, 0.5f}, {1e-5f, -0.7f, 3e-3f, 1.f}}) {
        filter->filter(flat_frame(window, float32, colour, d), coc_as_depth);
        expect_flat(filter->result(), colour, std::to_string(window.width()) + " wide, CoC " + std::to_string(d));
        ASSERT_FALSE(HasFailure());
      }
    }
  }
}

TEST(Analytic, AConstantImageStaysConstantWhateverTheCoCs) {
  std::mt19937 random(1);
  const test::Rgba colour{0.18f, 1e-5f, 700.f, 0.25f};
  for (const Window& window : windows) {
    const auto filter = make_linear_filter(window, options_up_to(400), default_table());
    for (const float largest : {1.f, 9.f, 120.f, 400.f}) {
      Frame frame = flat_frame(window, float32, colour, 0);
      std::uniform_real_distribution<float> diameter(-largest, largest);
      for_each_in(window, [&](int x, int y) { frame.depth.at(x, y) = diameter(random); });
      filter->filter(frame, coc_as_depth);
      expect_flat(filter->result(), colour, "CoC up to " + std::to_string(largest));
    }
  }
}

TEST(Analytic, ABrightPixelBecomesItsKernel) {
  const Window window{-20, 5, 41, 50};
  const int at_x = 10, at_y = 27;
  const auto filter = make_linear_filter(window, options_up_to(400), default_table());
  for (const float d : {0.5f, 1.f, 2.f, 3.5f, 8.f, -15.f, 30.f}) {
    Frame frame = flat_frame(window, float32, {0, 0, 0, 1}, d);
    test::set_colour(frame.colour, at_x, at_y, {1, 1, 1, 1});
    filter->filter(frame, coc_as_depth);
    const Kernel& kernel = default_table()->kernel(default_table()->coc().index(d));
    for_each_in(window, [&](int x, int y) {
      const std::int64_t weight = kernel.weight(x - at_x, y - at_y);
      const double expected = static_cast<double>(weight) / static_cast<double>(kernel.total());
      const float is = filter->result().get(x, y, 0);
      ASSERT_NEAR(is, expected, 1e-6) << d << " px, at " << x << "," << y;
      ASSERT_EQ(weight == 0, is == 0.f) << d << " px, at " << x << "," << y;
    });
  }
}

TEST(Analytic, EnergyIsKeptAtBordersAndInCornersToo) {
  const Window window{0, 0, 45, 31};
  const auto filter = make_linear_filter(window, options_up_to(400), default_table());
  for (const float d : {1.f, 7.f, -24.f, 64.f, 150.f}) {
    for (const auto& [at_x, at_y] : {std::pair{22, 15}, {0, 0}, {44, 30}, {44, 1}, {3, 29}, {20, 0}}) {
      Frame frame = flat_frame(window, float32, {0, 0, 0, 1}, d);
      frame.colour.set(at_x, at_y, 1, 1000.f);
      filter->filter(frame, coc_as_depth);
      double sum = 0;
      for_each_in(window, [&](int x, int y) { sum += static_cast<double>(filter->result().get(x, y, 1)); });
      ASSERT_NEAR(sum, 1000, 1e-3) << d << " px, at " << at_x << "," << at_y;
    }
  }
}

TEST(Analytic, InFocusHalfComesOutExactly) {
  const Window window{0, 0, 256, 248};  // every finite half, in every channel
  Frame frame{ColourImage(window, half), Plane(window, 0.f)};
  int bits = 0;
  for_each_in(window, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      const int of_channel = (bits + c * 997) % 63488;
      const int sign_and_magnitude = of_channel < 31744 ? of_channel : of_channel - 31744 + 32768;
      frame.colour.set(x, y, c, finite_half_to_float(static_cast<std::uint16_t>(sign_and_magnitude)));
    }
    ++bits;
  });
  FilterOptions options = options_up_to(2);
  for (const SampleType type : {half, float32}) {
    options.output_type = type;
    const auto filter = make_linear_filter(window, options);
    filter->filter(frame, coc_as_depth);
    for_each_in(window, [&](int x, int y) {
      for (int c = 0; c < 4; ++c) ASSERT_EQ(filter->result().get(x, y, c), frame.colour.get(x, y, c));
    });
  }
}

TEST(Analytic, InFocusFloatComesOutWithin2ToTheMinus41) {
  const Window window{0, 0, 90, 40};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-50, 15.9f), sign(-1, 1);
  Frame frame{ColourImage(window, float32), Plane(window, 0.f)};
  for_each_in(window, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, std::copysign(std::exp2(exponent(random)), sign(random)));
  });
  const auto filter = make_linear_filter(window, options_up_to(2));
  filter->filter(frame, coc_as_depth);
  for_each_in(window, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      const double was = static_cast<double>(frame.colour.get(x, y, c));
      ASSERT_NEAR(static_cast<double>(filter->result().get(x, y, c)), was, 0x1p-41);
    }
  });
}

TEST(Analytic, NearAndFarBlurAlike) {
  const Window window{0, 0, 50, 30};
  test::RandomShot shot(window, 6, half, true, false);
  const auto filter = make_linear_filter(window, options_up_to(40));
  for (const float d : {0.7f, 6.f, 39.f}) {
    Frame frame = shot.frame();
    frame.depth.reset(window, d);
    filter->filter(frame, coc_as_depth);
    const ColourImage far = filter->result();
    frame.depth.reset(window, -d);
    filter->filter(frame, coc_as_depth);
    ASSERT_EQ(test::difference(filter->result(), far), "") << d << " px";
  }
}

struct Case {
  Window window;
  float largest_px;
  double pixel_aspect;
  SampleType type;
  DepthKind kind;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.window.width() << "x" << c.window.height() << " to " << c.largest_px << " px, aspect "
             << c.pixel_aspect << ", " << name(c.kind);
}

class NaiveAgreement : public testing::TestWithParam<Case> {};

TEST_P(NaiveAgreement, HoldsWithin1e6OfTheValue) {
  const Case& c = GetParam();
  FilterOptions options = options_up_to(static_cast<double>(c.largest_px));
  options.kernel.pixel_aspect = c.pixel_aspect;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto filter = make_linear_filter(c.window, options, kernels);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    test::RandomShot shot(c.window, seed, c.type, seed % 2 == 0, false);
    Frame frame = shot.frame();
    CocFunction coc = test::random_lens(shot.random(), c.largest_px);
    if (c.kind == DepthKind::coc) {
      coc = coc_as_depth;
      std::uniform_real_distribution<float> diameter(-1.2f * c.largest_px, 1.2f * c.largest_px);
      for_each_in(c.window, [&](int x, int y) { frame.depth.at(x, y) = diameter(shot.random()); });
    }
    filter->filter(frame, coc);
    const test::NaiveImage expected = test::naive_scatter(frame, coc, *kernels);
    for_each_in(c.window, [&](int x, int y) {
      for (int channel = 0; channel < 4; ++channel) {
        const double value = expected.at(x, y, channel);
        ASSERT_NEAR(static_cast<double>(filter->result().get(x, y, channel)), value,
                    1e-6 * std::max(1., std::fabs(value)))
            << x << "," << y << ", seed " << seed;
      }
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, NaiveAgreement,
                         testing::Values(Case{{0, 0, 1, 1}, 30, 1, half, DepthKind::planar},
                                         Case{{0, 0, 1, 11}, 50, 1, float32, DepthKind::coc},
                                         Case{{-9, 4, 4, 9}, 70, 1, half, DepthKind::coc},
                                         Case{{0, 0, 40, 21}, 25, 1, float32, DepthKind::planar},
                                         Case{{5, 5, 70, 22}, 12, 2, half, DepthKind::planar},
                                         Case{{0, 0, 33, 65}, 18, 0.5, float32, DepthKind::coc}));

}  // namespace
}  // namespace pullfocus
