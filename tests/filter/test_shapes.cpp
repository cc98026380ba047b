// What holds for the kernels of every shape: weights, footprint, set-in, orientation, and the table made of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "filter/incremental_filter.h"
#include "image/error.h"
#include "plain_frames.h"
#include "reference.h"
#include "scatter/kernel_table.h"
#include "shapes.h"

namespace pullfocus {
namespace {

using test::moments_of;

KernelTable table_of(const KernelShape& shape, double max_coc = 64, double aspect = 1, double step = 1. / 32) {
  KernelOptions options;
  options.coc_step = step;
  options.max_coc_px = max_coc;
  options.pixel_aspect = aspect;
  options.shape = shape;
  return KernelTable(options);
}

// How far from the source light may fall, in pixels.
double reach(const KernelShape& shape, double diameter) {
  switch (shape.kind) {
    case KernelShape::Kind::gaussian:
      return 0.75 * 1.0263 * std::max(2., diameter);
    case KernelShape::Kind::diffraction:
      return 0.625 * std::max(2., diameter) + 0.5;
    case KernelShape::Kind::disc:
      return (std::max(2., diameter) + 0.6) / 2 + 0.5;  // its diameter is adjusted by up to 0.3 px
    default:
      return std::max(2., diameter) / 2 + 0.5;
  }
}

class Shapes : public testing::TestWithParam<std::size_t> {
 protected:
  const KernelShape shape = test::all_shapes()[GetParam()];
};

TEST_P(Shapes, WeightsAreNotNegativeSumToTheUnitAndStayWithinTheFootprint) {
  for (const double aspect : {1., 0.5, 2.}) {
    const KernelTable table = table_of(shape, aspect == 1 ? 250 : 60, aspect, aspect == 1 ? 1. / 32 : 0);
    for (int i = -table.coc().size() + 1; i < table.coc().size(); ++i) {
      const Kernel& kernel = table.kernel(i);
      const double d = table.coc().diameter(i);
      ASSERT_LE(std::fabs(static_cast<double>(kernel.total() - kWeightUnit)), 1e-7 * static_cast<double>(kWeightUnit));
      ASSERT_LE(kernel.radius_x, reach(shape, d)) << d;
      ASSERT_LE(kernel.radius_y, std::max(1., reach(shape, d) * std::max(1., aspect))) << d;
      ASSERT_LE(kernel.steps.size(), kMaxKernelSteps);
      ASSERT_LE(kernel.levels.size(), 18u);  // 16, the outside, and the centre below 2 px
      ASSERT_TRUE(std::is_sorted(kernel.levels.begin(), kernel.levels.end(), std::less_equal<>()));
      ASSERT_EQ(kernel.levels[0], 0);
    }
  }
}

TEST_P(Shapes, BlurSetsInSmoothlyFromTheIdentity) {
  const KernelTable table = table_of(shape, 8);
  const Kernel& identity = table.kernel(0);
  EXPECT_EQ(identity.radius_x, 0);
  EXPECT_EQ(identity.weight(0, 0), kWeightUnit);
  double before = 0;
  for (int i = 1; i < table.coc().size(); ++i) {
    const test::Moments m = moments_of(table.kernel(i));
    const double moment = (m.xx + m.yy) / 2;
    EXPECT_GT(moment, before) << table.coc().diameter(i);
    const bool picture = shape.kind == KernelShape::Kind::image;                   // noisy ones hold more light far out
    EXPECT_LE(moment - before, picture ? 0.81 : 0.53) << table.coc().diameter(i);  // px^2, a half-pixel step
    before = moment;
  }
}

TEST_P(Shapes, Below2PixelsTheSecondMomentGrowsWithTheSquareOfTheDiameter) {
  const KernelTable table = table_of(shape, 2);
  const test::Moments at_2 = moments_of(table.kernel(4));
  for (int i = 0; i < 4; ++i) {
    const double d = table.coc().diameter(i);
    EXPECT_NEAR(moments_of(table.kernel(i)).xx, d * d / 4 * at_2.xx, 1e-9);
    EXPECT_NEAR(moments_of(table.kernel(i)).yy, d * d / 4 * at_2.yy, 1e-9);
  }
}

TEST_P(Shapes, InFrontOfFocusTheKernelIsTurnedByHalfATurn) {
  const KernelTable table = table_of(shape, 40);
  for (int i = 0; i < table.coc().size(); ++i) {
    const Kernel &behind = table.kernel(i), &front = table.kernel(-i);
    ASSERT_EQ(behind.edge_count(), front.edge_count());
    for (int dy = -behind.radius_y; dy <= behind.radius_y; ++dy) {
      for (int dx = -behind.radius_x; dx <= behind.radius_x; ++dx) {
        ASSERT_EQ(behind.weight(dx, dy), front.weight(-dx, -dy)) << i << ": " << dx << "," << dy;
      }
    }
  }
}

TEST_P(Shapes, SymmetricSaysWhetherEveryKernelIsItsOwnMirrorImage) {
  const KernelTable table = table_of(shape, 40);
  bool symmetric = true;
  for (int i = 0; i < table.coc().size(); ++i) {
    const Kernel& kernel = table.kernel(i);
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) {
        symmetric &= kernel.weight(dx, dy) == kernel.weight(-dx, dy) && kernel.weight(dx, dy) == kernel.weight(dx, -dy);
      }
    }
  }
  EXPECT_EQ(table.symmetric(), symmetric);
}

TEST_P(Shapes, TheOverlapBoundHoldsForEverySignAndMirrorImage) {
  const KernelTable table = table_of(shape, 24);
  int reach = 0;
  for (int i = 0; i < table.coc().size(); ++i) {
    reach = std::max({reach, table.kernel(i).radius_x, table.kernel(i).radius_y});
  }
  double sum = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      std::int64_t largest = 0;
      for (int i = -table.coc().size() + 1; i < table.coc().size(); ++i) {
        for (const int x : {-dx, dx}) {
          for (const int y : {-dy, dy}) largest = std::max(largest, table.kernel(i).weight(x, y));
        }
      }
      sum += static_cast<double>(largest);
    }
  }
  EXPECT_NEAR(table.overlap_bound(), sum / static_cast<double>(kWeightUnit), 1e-9);
}

// With one CoC over the whole picture, as near to a border as may be.
TEST_P(Shapes, TheWeightOfAConstantCocIsOneUnitEverywhereBordersAndCornersIncluded) {
  for (const Window& window : {Window{0, 0, 37, 23}, Window{0, 0, 9, 5}, Window{0, 0, 1, 6}, Window{0, 0, 90, 40}}) {
    for (const float coc : {0.5f, 3.f, -7.5f, 12.f, -30.f, 30.f}) {
      FilterOptions options = test::options_up_to(30);
      options.kernel.shape = shape;
      IncrementalFilter filter(window, options);
      filter.filter(test::flat_frame(window, SampleType::float32, {0.7f, 0.7f, 0.7f}, coc), test::coc_as_depth);
      const KernelTable table(options.kernel);
      const auto unit = static_cast<Accumulator>(table.kernel(table.coc().index(coc)).total());
      for (std::size_t i = 0; i < window.pixels(); ++i) {
        ASSERT_EQ(filter.accumulators()[i * kOpaqueLanes + kWeightLane], unit) << coc << " at " << i;
      }
      test::for_each_in(window, [&](int x, int y) { ASSERT_NEAR(filter.result().get(x, y, 0), 0.7f, 1e-7f); });
    }
  }
}

// Whichever cell of a band a footprint, or its image beyond the border, ends in, and whatever the next call makes of
// the band's memory.
TEST_P(Shapes, SingleChangesAreTakenBackWhereverTheyAndTheirMirrorImagesEnd) {
  FilterOptions options = test::options_up_to(12);
  options.kernel.shape = shape;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  std::mt19937 random(3);
  for (int width = 5; width < 75; width += 2) {
    const Window window{0, 0, width, 19};
    IncrementalFilter filter(window, options, kernels);
    Frame frame = test::flat_frame(window, SampleType::half, {0.5f, 0.25f, 1}, 1);
    filter.filter(frame, test::coc_as_depth);
    for (int change = 0; change < 6; ++change) {
      const int x = static_cast<int>(random() % static_cast<unsigned>(width)), y = static_cast<int>(random() % 19);
      frame.colour.set(x, y, 0, 7);
      frame.depth.at(x, y) = static_cast<float>(random() % 49) / 2 - 12;
      filter.filter(frame, test::coc_as_depth);
    }
    ASSERT_TRUE(test::invariant_holds(filter, *kernels)) << width << " wide";
  }
}

INSTANTIATE_TEST_SUITE_P(All, Shapes, testing::Range(std::size_t{0}, test::all_shapes().size()));

TEST(KernelShape, WrongShapesAreNamed) {
  const auto message = [](const KernelShape& shape) {
    try {
      validate(shape);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(message(test::polygon(3)), "none");
  EXPECT_NE(message(test::polygon(2)).find("--kernel"), std::string::npos);
  EXPECT_NE(message(test::polygon(17)).find("--kernel"), std::string::npos);
  EXPECT_NE(message(test::polygon(5, NAN)).find("--blade-rotation"), std::string::npos);
  EXPECT_NE(message(test::polygon(5, 0, 1.01)).find("--blade-roundness"), std::string::npos);
  EXPECT_NE(message(test::polygon(5, 0, NAN)).find("--blade-roundness"), std::string::npos);
  EXPECT_NE(message(test::of_kind(KernelShape::Kind::image)).find("--kernel image"), std::string::npos);
  EXPECT_NE(message(test::picture_of(3, 3, [](double, double) { return 0; })).find("black"), std::string::npos);
  EXPECT_NE(message(test::picture_of(3, 3, [](double, double) { return -1; })).find("negative"), std::string::npos);
  for (const char* text : {"", "square", "polygon", "polygon:", "polygon:2", "polygon:5x", "polygon:-3", "image:x"}) {
    EXPECT_THROW(KernelShape::parse(text), Error) << text;
  }
  EXPECT_EQ(KernelShape::parse("polygon:16").blades, 16);
  EXPECT_EQ(KernelShape::parse("gaussian").kind, KernelShape::Kind::gaussian);
}

}  // namespace
}  // namespace pullfocus
