// Pictures to measure.
#pragma once

#include <functional>

#include "image/frame.h"

namespace pullfocus::test {

using ColourAt = std::function<float(int x, int y, int channel)>;  // channels 0..2; alpha is 1

ColourImage picture(const Window& window, const ColourAt& colour);
ColourImage constant(const Window& window, float r, float g, float b);
ColourImage random_picture(const Window& window, unsigned seed, float largest = 1);

// A pair given by formulas, for values computed elsewhere: stripes, squares, checks; the second one is shifted, has a
// flat disc in it, and is darker above a diagonal. Window 0,0 to width,height.
struct Pair {
  ColourImage first, second;
};
Pair formula_pair(int width, int height);

}  // namespace pullfocus::test
