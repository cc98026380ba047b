// Random shots: frames that change in parts, the way rendered sequences do, and cameras that move.
#pragma once

#include <random>

#include "camera/thin_lens.h"
#include "image/frame.h"

namespace pullfocus::test {

class RandomShot {
 public:
  // `hostile` adds NaN, infinities, negative and huge colours, and invalid depths.
  RandomShot(const Window& window, unsigned seed, SampleType type, bool with_alpha, bool hostile);

  const Frame& frame() const { return frame_; }
  std::mt19937& random() { return random_; }

  // Changes a random rectangle, a random scattering of pixels, everything, or nothing.
  const Frame& step();
  void use_type(SampleType type);  // for the next frames

  // From now on step() draws masks too: none, all, or a random rectangle over what was.
  void use_masks();

 private:
  void draw(int x, int y);
  void draw_window(const Window& part);
  void draw_mask();
  float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  std::mt19937 random_;
  std::mt19937 mask_random_;
  bool with_alpha_, hostile_, masks_ = false;
  Frame frame_;
};

// A plausible lens over depths of about 1 to 10, with diameters up to roughly `largest_px` for distant sources.
CocFunction random_lens(std::mt19937& random, float largest_px);

}  // namespace pullfocus::test
