// The quantisation of diameters, and what a table of kernels refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "camera/usage.h"
#include "scatter/kernel_table.h"

namespace pullfocus {
namespace {

constexpr double steps[] = {0, 1. / 32, 0.1, 0.25, 1};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// Calls check(table, step) for many lengths and steps, among them lengths between the steps.
template <typename Check>
void for_each_table(Check&& check) {
  std::vector<double> lengths{33.3, 64., 127.97, 399.95, 400., 499.97, 500.};
  for (double length = 1; length <= 24; length += 1. / 16) lengths.push_back(length);
  for (const double step : steps) {
    for (const double length : lengths) {
      check(CocTable(step, length), step);
      ASSERT_FALSE(testing::Test::HasFailure()) << "step " << step << ", up to " << length << " px";
    }
  }
}

TEST(CocTable, EveryDiameterHasItsOwnIndexOnBothSides) {
  for_each_table([](const CocTable& table, double) {
    for (int i = 0; i < table.size(); ++i) {
      const auto diameter = static_cast<float>(table.diameter(i));
      ASSERT_EQ(table.index(diameter), i) << "of " << table.size() << ", diameter " << diameter;
      ASSERT_EQ(table.index(-diameter), -i);
      ASSERT_EQ(table.diameter(-i), table.diameter(i));
    }
  });
}

TEST(CocTable, StepsAreHalfAPixelOrAShareOfTheDiameterWithinA32nd) {
  for_each_table([](const CocTable& table, double step) {
    ASSERT_EQ(table.diameter(0), 0);
    for (int i = 0; i + 1 < table.size(); ++i) {
      const double d = table.diameter(i), expected = std::max(0.5, step * d), is = table.diameter(i + 1) - d;
      ASSERT_EQ(std::fmod(table.diameter(i + 1) * 16, 1.), 0) << "not a sixteenth of a pixel";
      // The last entry is the largest diameter, wherever the steps would have led.
      const bool is_last = i + 2 == table.size();
      ASSERT_GE(is, is_last ? 1. / 16 : expected - 1. / 32);
      ASSERT_LE(is, expected + (is_last ? 3. / 32 : 1. / 32));
    }
  });
}

TEST(CocTable, TheLargestDiameterIsTheOneAskedForWithinA32nd) {
  for (const double max_coc : {1., 1.03, 77.77, 499.99, 500.}) {
    const CocTable table(1. / 32, max_coc);
    EXPECT_NEAR(table.diameter(table.size() - 1), max_coc, 1. / 32);
    EXPECT_EQ(static_cast<double>(table.max_diameter()), table.diameter(table.size() - 1));
  }
}

TEST(CocTable, TheIndexIsMonotoneAndNearestWithinHalfAStepAndASixteenth) {
  for_each_table([](const CocTable& table, double) {
    int before = 0;
    for (float c = 0; c <= table.max_diameter(); c += 0.0371f) {
      const int i = table.index(c);
      ASSERT_GE(i, before);
      ASSERT_LE(i, before + 1);
      ASSERT_EQ(table.index(-c), -i);
      const double d = table.diameter(i), distance = std::fabs(static_cast<double>(c) - d);
      const int neighbour = static_cast<double>(c) < d ? std::max(i - 1, 0) : std::min(i + 1, table.size() - 1);
      ASSERT_LE(distance, std::fabs(table.diameter(neighbour) - d) / 2 + 1. / 16) << "at " << c;
      before = i;
    }
  });
}

TEST(CocTable, BeyondTheLargestDiameterEverythingIsTheLargest) {
  for_each_table([](const CocTable& table, double) {
    const int last = table.size() - 1;
    const float d = table.max_diameter();
    for (const float c : {d, std::nextafter(d, infinity), d + 1, 1e30f, infinity}) {
      ASSERT_EQ(table.index(c), last);
      ASSERT_EQ(table.index(-c), -last);
    }
    ASSERT_EQ(std::abs(table.index(std::numeric_limits<float>::quiet_NaN())), last);
  });
}

TEST(CocTable, InFocusBothZerosAreIndex0) {
  const CocTable table(1. / 32, 400);
  EXPECT_EQ(table.index(0.f), 0);
  EXPECT_EQ(table.index(-0.f), 0);
  EXPECT_EQ(table.index(1e-30f), 0);
  EXPECT_EQ(table.index(-1e-30f), 0);
}

TEST(KernelTable, TheOverlapBoundIsTheSumOfTheLargestWeights) {
  KernelOptions options;
  options.max_coc_px = 13;
  options.pixel_aspect = 1.4;
  const KernelTable table(options);
  double sum = 0;
  for (int dy = -20; dy <= 20; ++dy) {
    for (int dx = -20; dx <= 20; ++dx) {
      std::int64_t largest = 0;
      for (int i = 0; i < table.coc().size(); ++i) {
        largest = std::max(largest, table.kernel(i).weight(dx, dy));
      }
      sum += static_cast<double>(largest);
    }
  }
  EXPECT_NEAR(table.overlap_bound(), sum / static_cast<double>(kWeightUnit), 1e-12 * sum);
}

TEST(KernelTable, DiscsOverlapLessThan2LnRPlus6Times) {
  for (const double step : {0., 1. / 32, 0.3}) {
    for (const double max_coc : {1., 2., 5., 31.5, 100., 500.}) {
      for (const double aspect : {1., 0.5, 2.}) {
        if (step == 0 && max_coc == 500 && aspect != 1) continue;  // slow, and says nothing more
        KernelOptions options{step, max_coc, aspect, 1000};
        const KernelTable table(options);
        int radius = 0;
        for (int i = 0; i < table.coc().size(); ++i) {
          radius = std::max({radius, table.kernel(i).radius_x, table.kernel(i).radius_y});
        }
        EXPECT_LT(table.overlap_bound(), 2 * std::log(radius) + 6) << max_coc << " px, aspect " << aspect;
        EXPECT_GE(table.overlap_bound(), 1);
      }
    }
  }
}

TEST(KernelTable, RefusesARadianceExactlyFromWhereASumCouldOverflow) {
  KernelOptions options;
  options.max_coc_px = 30;
  const double limit = 0x1p23 / KernelTable(options).overlap_bound() - 1;
  options.max_radiance = static_cast<float>(limit * (1 - 1e-6));
  EXPECT_NO_THROW(KernelTable{options});
  options.max_radiance = static_cast<float>(limit * (1 + 1e-6));
  expect_usage_error([&] { KernelTable{options}; }, "--max-radiance");
}

TEST(KernelTable, RefusesEveryOptionOutOfRangeByName) {
  const auto refuses = [](auto field, std::initializer_list<double> values, const char* name) {
    for (const double value : values) {
      KernelOptions options;
      options.max_coc_px = 4;
      options.*field = static_cast<std::remove_reference_t<decltype(options.*field)>>(value);
      expect_usage_error([&] { KernelTable{options}; }, name);
    }
  };
  refuses(&KernelOptions::coc_step, {-0.01, 1.01, nan}, "--coc-step");
  refuses(&KernelOptions::max_coc_px, {-1, 0, 0.99, 500.01, 1e30, nan}, "--max-coc");
  refuses(&KernelOptions::pixel_aspect, {-1, 0, 0.1, 10, 1e30, nan}, "pixelAspectRatio");
  refuses(&KernelOptions::max_radiance, {-1, 0, 1e7, 1e39, nan}, "--max-radiance");
}

}  // namespace
}  // namespace pullfocus
