// Windows against sets of pixels.
#include "image/window.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pullfocus {
namespace {

constexpr Window all{-12, -12, 13, 13};

// Calls visit(x, y) for every pixel near the origin.
template <typename Visit>
void for_each_near(Visit&& visit) {
  for (int y = all.y0; y < all.y1; ++y) {
    for (int x = all.x0; x < all.x1; ++x) visit(x, y);
  }
}

// Windows of all sizes, some empty, some inside out.
std::vector<Window> random_windows(int n) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(-9, 9);
  std::vector<Window> windows{{}, {3, 3, 3, 9}, {3, 3, 9, 3}, {5, 5, 2, 2}, {5, 0, 2, 9}};
  while (static_cast<int>(windows.size()) < n) {
    windows.push_back({place(random), place(random), place(random), place(random)});
  }
  return windows;
}

TEST(Window, HoldsAsManyPixelsAsItContains) {
  for (const Window& w : random_windows(60)) {
    std::size_t pixels = 0;
    for_each_near([&](int x, int y) { pixels += w.contains(x, y); });
    EXPECT_EQ(w.pixels(), pixels);
    EXPECT_EQ(w.empty(), pixels == 0);
    if (!w.empty()) {
      EXPECT_EQ(static_cast<std::size_t>(w.width()) * static_cast<std::size_t>(w.height()), pixels);
    }
  }
}

TEST(Window, IntersectionContainsWhatBothContain) {
  for (const Window& a : random_windows(40)) {
    for (const Window& b : random_windows(40)) {
      const Window both = intersect(a, b);
      for_each_near([&](int x, int y) { ASSERT_EQ(both.contains(x, y), a.contains(x, y) && b.contains(x, y)); });
    }
  }
}

TEST(Window, UnionIsTheSmallestThatContainsBoth) {
  for (const Window& a : random_windows(40)) {
    for (const Window& b : random_windows(40)) {
      Window expected;
      for_each_near([&](int x, int y) {
        if (!a.contains(x, y) && !b.contains(x, y)) return;
        if (expected.empty()) expected = {x, y, x + 1, y + 1};
        expected = {std::min(expected.x0, x), std::min(expected.y0, y), std::max(expected.x1, x + 1),
                    std::max(expected.y1, y + 1)};
      });
      const Window united = unite(a, b);
      ASSERT_EQ(united.empty(), expected.empty());
      if (!expected.empty()) {
        ASSERT_EQ(united, expected);
      }
    }
  }
}

TEST(Window, GrowsByAsMuchOnBothSidesAndShrinksBack) {
  const Window w{-3, 4, 10, 5};
  EXPECT_EQ(grow(w, 2, 7), (Window{-5, -3, 12, 12}));
  for (const Window& any : random_windows(20)) EXPECT_EQ(grow(grow(any, 5, 3), -5, -3), any);
}

TEST(Window, CountsMorePixelsThanAnIntHolds) { EXPECT_EQ((Window{0, 0, 70000, 70000}.pixels()), 4900000000u); }

}  // namespace
}  // namespace pullfocus
