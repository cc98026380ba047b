// Random changes of a committed state.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "importance/order.h"
#include "plain_frames.h"

namespace pullfocus::test {

struct Change {
  Frame frame;
  SourceState state;
  std::vector<std::int16_t> index;
  ColourImage shown;
};

// Any colours and indices before and after; every third pixel keeps its index, some were never committed or held out.
inline Change random_change(const Window& window, SampleType type, int indices, std::mt19937& random) {
  std::uniform_real_distribution<float> exponent(-8, 3);
  const auto noise = [&](ColourImage& image) {
    image.reset(window, type);
    for_each_in(window, [&](int x, int y) {
      for (int c = 0; c < 4; ++c) image.set(x, y, c, std::exp2(exponent(random)));
    });
  };
  const auto any_index = [&] {
    return static_cast<std::int16_t>(static_cast<int>(random() % (2u * indices - 1)) - indices + 1);
  };
  Change change;
  noise(change.frame.colour);
  change.frame.depth.reset(window, 1);
  change.state.reset(window, type);
  noise(change.state.colour);
  noise(change.shown);
  for (std::int16_t& index : change.state.index) {
    index = any_index();
    change.index.push_back(random() % 3 ? any_index() : index);
    if (random() % 20 == 0) index = kHeldOut;
    if (random() % 20 == 0) index = kNeverCommitted;
  }
  for (int y = window.y0; y < window.y1; y += 2) {  // some keep their colour
    for (int x = window.x0; x < window.x1; x += 3) {
      for (int c = 0; c < 4; ++c) change.frame.colour.set(x, y, c, change.state.colour.get(x, y, c));
    }
  }
  return change;
}

}  // namespace pullfocus::test
