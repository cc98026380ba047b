// From colours, depths and diameters to what a screen shows.
#pragma once

#include "camera/thin_lens.h"
#include "image/frame.h"
#include "preview/state.h"

namespace pullfocus::cli::preview {

// Exposure and encoding of a Look, as a table over all halves.
class ToneTable {
 public:
  ToneTable() : ToneTable(0, true) {}
  // 2^exposure times a linear value, cut to 0..1, sRGB-encoded or not. NaN is black.
  ToneTable(float exposure, bool srgb);

  float exposure() const noexcept { return exposure_; }
  bool srgb() const noexcept { return srgb_; }
  std::uint8_t operator()(std::uint16_t half) const noexcept { return of_half_[half]; }
  std::uint8_t operator()(float value) const noexcept;  // through the nearest half

 private:
  float exposure_;
  bool srgb_;
  std::vector<std::uint8_t> of_half_;
};

// All of these: `out` gets the size of the window. They run in the calling task arena.

// Colours over black (premultiplied alpha is what it is).
void show_colour(const ColourImage& colour, const ToneTable& tone, Picture& out);
// Columns left of `end` (0..width) only; the rest stays.
void show_colour_left_of(int end, const ColourImage& colour, const ToneTable& tone, Picture& out);

// The 1st and the 99th percentile of the surfaces' depths, from a sample of the pixels; 0 and 0 without any. Planar.
struct DepthRange {
  float near = 0, far = 0;
};
DepthRange depth_range(const Frame& frame);

// Near bright, far dark, linear in inverse depth over the range of the frame; background black. For DepthKind::coc as
// show_coc().
void show_depth(const Frame& frame, DepthKind kind, Picture& out);

// Signed CoC: in front of focus red, behind it blue, in focus (up to 1 px) green, the more saturated the larger (full
// at `full_px`), shaded by the frame's own brightness. Without a lens (null) all is grey.
void show_coc(const Frame& frame, const CocFunction* coc, double full_px, Picture& out);

// Importance of pending pixels on a logarithmic scale of 16 octaves below the largest: black none, then violet, red,
// yellow, white. Infinite counts as largest.
void show_importance(const Plane& importance, Picture& out);

// |a - b| of each channel, through `tone`. Same windows.
void show_difference(const ColourImage& a, const ColourImage& b, const ToneTable& tone, Picture& out);

}  // namespace pullfocus::cli::preview
