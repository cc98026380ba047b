// Properties that every kernel of a table has, whatever its size.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "scatter/kernel_table.h"

namespace pullfocus {
namespace {

struct Case {
  double coc_step, max_coc_px, pixel_aspect;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << "step " << c.coc_step << " to " << c.max_coc_px << " px, aspect " << c.pixel_aspect;
}

const KernelTable& table_of(const Case& c) {
  static std::map<std::array<double, 3>, KernelTable> tables;
  KernelOptions options;
  options.coc_step = c.coc_step;
  options.max_coc_px = c.max_coc_px;
  options.pixel_aspect = c.pixel_aspect;
  return tables.try_emplace({c.coc_step, c.max_coc_px, c.pixel_aspect}, options).first->second;
}

class Kernels : public testing::TestWithParam<Case> {
 protected:
  const KernelTable& table() const { return table_of(GetParam()); }

  // Calls check(kernel) for every entry, and says which one failed.
  template <typename Check>
  void for_each_kernel(Check&& check) const {
    for (int i = 0; i < table().coc().size(); ++i) {
      const Kernel& kernel = table().kernel(i);
      check(kernel);
      ASSERT_FALSE(HasFailure()) << "index " << i << ", diameter " << table().coc().diameter(i);
    }
  }
};

// One weight for all pixels leaves up to half a count each: more than 1e-7 from 220 000 pixels on, which
// takes tall pixels.
TEST_P(Kernels, SumToTheUnitWithin1e7OrHalfACountAPixel) {
  for_each_kernel([](const Kernel& kernel) {
    std::int64_t sum = 0, pixels = 0;
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) {
        sum += kernel.weight(dx, dy);
        pixels += kernel.weight(dx, dy) > 0;
      }
    }
    const double bound = std::max(1e-7 * static_cast<double>(kWeightUnit), static_cast<double>(pixels) / 2);
    EXPECT_EQ(kernel.total(), sum);
    EXPECT_LE(std::fabs(static_cast<double>(sum - kWeightUnit)), bound);
  });
}

TEST_P(Kernels, EndExactlyAtTheirStatedRadius) {
  for_each_kernel([](const Kernel& kernel) {
    const int rx = kernel.radius_x, ry = kernel.radius_y;
    bool reaches_x = false, reaches_y = false, outside = false;
    for (int dy = -ry - 2; dy <= ry + 2; ++dy) {
      reaches_x |= kernel.weight(rx, dy) > 0;
      outside |= kernel.weight(rx + 1, dy) != 0 || kernel.weight(-rx - 1, dy) != 0;
      outside |= kernel.weight(rx + 1000, dy) != 0 || kernel.weight(-rx - 1000, dy) != 0;
    }
    for (int dx = -rx - 2; dx <= rx + 2; ++dx) {
      reaches_y |= kernel.weight(dx, ry) > 0;
      outside |= kernel.weight(dx, ry + 1) != 0 || kernel.weight(dx, -ry - 1) != 0;
    }
    EXPECT_TRUE(reaches_x && reaches_y);
    EXPECT_FALSE(outside);
  });
}

TEST_P(Kernels, AreMirrorSymmetricAndNonNegative) {
  for_each_kernel([](const Kernel& kernel) {
    bool symmetric = true, non_negative = true;
    for (int dy = 0; dy <= kernel.radius_y; ++dy) {
      for (int dx = 0; dx <= kernel.radius_x; ++dx) {
        const std::int64_t weight = kernel.weight(dx, dy);
        non_negative &= weight >= 0;
        symmetric &=
            weight == kernel.weight(-dx, dy) && weight == kernel.weight(dx, -dy) && weight == kernel.weight(-dx, -dy);
      }
    }
    EXPECT_TRUE(non_negative);
    EXPECT_TRUE(symmetric);
  });
}

class KernelsOfSquarePixels : public Kernels {};

TEST_P(KernelsOfSquarePixels, LookTheSameLyingOnTheirSide) {
  for_each_kernel([](const Kernel& kernel) {
    EXPECT_EQ(kernel.radius_x, kernel.radius_y);
    bool symmetric = true;
    for (int dy = 0; dy <= kernel.radius_y; ++dy) {
      for (int dx = 0; dx < dy; ++dx) symmetric &= kernel.weight(dx, dy) == kernel.weight(dy, dx);
    }
    EXPECT_TRUE(symmetric);
  });
}

TEST_P(Kernels, NeverGrowAwayFromTheirCentreAlongARowOrColumn) {
  for_each_kernel([](const Kernel& kernel) {
    bool grows = false;
    for (int dy = 0; dy <= kernel.radius_y; ++dy) {
      for (int dx = 0; dx <= kernel.radius_x; ++dx) {
        const std::int64_t weight = kernel.weight(dx, dy);
        grows |= kernel.weight(dx + 1, dy) > weight || kernel.weight(dx, dy + 1) > weight;
      }
    }
    EXPECT_FALSE(grows);
  });
}

TEST_P(Kernels, HaveAnEdgeExactlyWhereTheWeightChangesAlongARow) {
  for_each_kernel([](const Kernel& kernel) {
    int edges = 0;
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      std::vector<int> expected, is;
      for (int dx = -kernel.radius_x; dx <= kernel.radius_x + 1; ++dx) {
        if (kernel.weight(dx, dy) != kernel.weight(dx - 1, dy)) expected.push_back(dx);
      }
      for (const KernelEdge& edge : kernel.row(dy)) is.push_back(edge.dx);
      EXPECT_EQ(is, expected) << "row " << dy;
      edges += static_cast<int>(expected.size());
    }
    EXPECT_EQ(kernel.edge_count(), edges);
    EXPECT_LE(kernel.steps.size(), kMaxKernelSteps);
  });
}

constexpr Case square[] = {{1. / 32, 400, 1}, {0, 500, 1}, {0.2, 333.3, 1}, {1, 500, 1}, {1. / 32, 1, 1}};
constexpr Case oblong[] = {{1. / 32, 90, 0.5}, {1. / 32, 90, 0.9}, {1. / 32, 200, 2},
                           {1. / 32, 500, 2},  {0, 40, 9.9},       {0, 70, 0.12}};

INSTANTIATE_TEST_SUITE_P(Square, Kernels, testing::ValuesIn(square));
INSTANTIATE_TEST_SUITE_P(Oblong, Kernels, testing::ValuesIn(oblong));
INSTANTIATE_TEST_SUITE_P(Square, KernelsOfSquarePixels, testing::ValuesIn(square));

TEST(KernelFromShares, KeepsProportionsAndTrimsEmptyMargins) {
  const Kernel kernel = kernel_from_shares(2, 1,
                                           {0, 0, 0, 0, 0,  //
                                            0, 3, 1, 0, 0,  //
                                            0, 0, 0, 0, 0});
  EXPECT_EQ(kernel.radius_x, 1);
  EXPECT_EQ(kernel.radius_y, 0);
  EXPECT_EQ(kernel.weight(-1, 0), 3 * (kWeightUnit / 4));
  EXPECT_EQ(kernel.weight(0, 0), kWeightUnit / 4);
  EXPECT_EQ(kernel.weight(1, 0), 0);
  EXPECT_EQ(kernel.total(), kWeightUnit);
  EXPECT_EQ(kernel.edge_count(), 3);
}

TEST(KernelFromShares, HoldsRunsWithGaps) {
  const Kernel kernel = kernel_from_shares(3, 0, {1, 0, 2, 2, 0, 0, 3});
  const std::int64_t eighth = kWeightUnit / 8;
  const std::int64_t expected[] = {eighth, 0, 2 * eighth, 2 * eighth, 0, 0, 3 * eighth};
  for (int dx = -3; dx <= 3; ++dx) EXPECT_EQ(kernel.weight(dx, 0), expected[dx + 3]);
}

}  // namespace
}  // namespace pullfocus
