#include "pictures.h"

#include <random>

namespace pullfocus::test {

ColourImage picture(const Window& window, const ColourAt& colour) {
  ColourImage image(window, SampleType::float32);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      for (int c = 0; c < 3; ++c) image.set(x, y, c, colour(x, y, c));
      image.set(x, y, 3, 1);
    }
  }
  return image;
}

ColourImage constant(const Window& window, float r, float g, float b) {
  return picture(window, [&](int, int, int c) { return c == 0 ? r : c == 1 ? g : b; });
}

ColourImage random_picture(const Window& window, unsigned seed, float largest) {
  std::mt19937 random(seed);
  return picture(window, [&](int, int, int) { return std::uniform_real_distribution<float>(0, largest)(random); });
}

Pair formula_pair(int width, int height) {
  const Window window{0, 0, width, height};
  const auto share = [](int value, int of) { return static_cast<float>(value % of) / static_cast<float>(of); };
  const auto first = [&](int x, int y, int c) {
    if (c == 0) return share(x * 7 + y * 3, 32);
    if (c == 1) return share(x * x + 5 * y, 64);
    return 0.75f * static_cast<float>((x / 5 + y / 7) % 2) + 0.125f * static_cast<float>((x + y) % 2);
  };
  const auto second = [&](int x, int y, int c) {
    if (c == 0) return share(x * 7 + y * 3 + x / 8, 32);
    const int dx = x - width / 2, dy = y - height / 2;
    if (c == 1) return dx * dx + dy * dy < 64 ? 0.25f : first(x, y, 1);
    return x > y ? 0.5f * first(x, y, 2) : first(x, y, 2);
  };
  return {picture(window, first), picture(window, second)};
}

}  // namespace pullfocus::test
