// Frames made by formula, whose depth is the signed CoC.
#pragma once

#include "camera/thin_lens.h"
#include "image/frame.h"

namespace pullfocus::cli::bench {

// Takes depth as the CoC.
inline constexpr CocFunction kDepthIsCoc{DepthKind::coc, 1, 0};

// Planes, a slanted floor and 6 % of noisy pixels, CoC up to `largest_coc` px across, noise as colour, opaque.
Frame planes_and_floor(int width, int height, float largest_coc, SampleType type = SampleType::half);

// Every pixel has a diameter within 1/16 of `largest_coc`, in smooth waves.
Frame waves(int width, int height, float largest_coc);

// Halves red in a share in [0, 1] of the pixels: in one patch in the middle, or in pixels at random.
enum class Pattern { patch, random };
void darken(Frame& frame, double share, Pattern pattern);

}  // namespace pullfocus::cli::bench
