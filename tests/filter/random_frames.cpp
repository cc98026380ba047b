#include "random_frames.h"

#include <cmath>
#include <limits>

namespace pullfocus::test {

RandomShot::RandomShot(const Window& window, unsigned seed, SampleType type, bool with_alpha, bool hostile)
    : random_(seed), mask_random_(seed), with_alpha_(with_alpha), hostile_(hostile) {
  frame_.colour.reset(window, type);
  frame_.depth.reset(window, 1.f);
  frame_.has_alpha = with_alpha;
  draw_window(window);
}

void RandomShot::draw(int x, int y) {
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float odd_colours[] = {nan, inf, -inf, -2.5f, 65504.f, 1e30f, 1e-7f, -0.f};
  constexpr float odd_depths[] = {nan, inf, -inf, 0.f, -3.f, 1e10f, 1e-42f, 1e-3f};
  const bool odd = hostile_ && below(20) == 0;
  for (int c = 0; c < 3; ++c) {
    frame_.colour.set(x, y, c, odd && below(2) ? odd_colours[below(8)] : uniform(0, below(30) ? 1.f : 300.f));
  }
  frame_.colour.set(x, y, 3, with_alpha_ ? (below(3) ? 1.f : uniform(0, 1)) : 1.f);
  // Few depths, so that neighbours share kernels, and some of their own.
  const float depths[] = {1.f, 1.5f, 2.f, 10.f};
  frame_.depth.at(x, y) = odd        ? odd_depths[below(8)]
                          : below(4) ? depths[static_cast<unsigned>(x / 7 + y / 5) % 4]
                                     : uniform(1, 10);
}

void RandomShot::draw_window(const Window& part) {
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) draw(x, y);
  }
}

void RandomShot::use_masks() {
  masks_ = true;
  draw_mask();
}

void RandomShot::draw_mask() {
  constexpr float values[] = {0.f, 0.499f, 0.5f, 1.f, std::numeric_limits<float>::quiet_NaN(), -1.f, 3.f};
  const auto random = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(mask_random_); };
  const Window& w = frame_.window();
  const int kind = random(8);
  if (kind == 0) return frame_.mask.reset({}, 0);
  if (kind < 3) return frame_.mask.reset(w, static_cast<float>(kind - 1));
  if (kind == 3) return;
  if (!frame_.has_mask()) frame_.mask.reset(w, 0);
  const int x = w.x0 + random(w.width()), y = w.y0 + random(w.height());
  const Window part = intersect(w, {x, y, x + 1 + random(w.width()), y + 1 + random(w.height())});
  for (int py = part.y0; py < part.y1; ++py) {
    for (int px = part.x0; px < part.x1; ++px) frame_.mask.at(px, py) = values[random(7)];
  }
}

const Frame& RandomShot::step() {
  if (masks_) draw_mask();
  const Window& w = frame_.window();
  switch (below(5)) {
    case 0:
      break;
    case 1:
      draw_window(w);
      break;
    case 2:
      for (int i = below(20); i >= 0; --i) draw(w.x0 + below(w.width()), w.y0 + below(w.height()));
      break;
    default: {
      const int x = w.x0 + below(w.width()), y = w.y0 + below(w.height());
      draw_window(intersect(w, {x, y, x + 1 + below(w.width()), y + 1 + below(w.height())}));
    }
  }
  return frame_;
}

void RandomShot::use_type(SampleType type) {
  ColourImage converted(frame_.window(), type);
  const Window& w = frame_.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 4; ++c) converted.set(x, y, c, frame_.colour.get(x, y, c));
    }
  }
  frame_.colour = std::move(converted);
}

CocFunction random_lens(std::mt19937& random, float largest_px) {
  std::uniform_real_distribution<float> uniform(0, 1);
  CocFunction coc;
  coc.inverse_focus = 0.1f + 0.9f * uniform(random);
  coc.scale = largest_px * uniform(random);
  return coc;
}

}  // namespace pullfocus::test
