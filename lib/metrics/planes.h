// Colour pictures as planes, ready to be measured.
#pragma once

#include <array>

#include "image/frame.h"
#include "metrics/convolve.h"

namespace pullfocus {

// What an 8-bit display without rounding would show: 0 for NaN, else clamped to 0..1.
inline float displayable(float value) noexcept { return value > 0 ? (value < 1 ? value : 1.f) : 0.f; }

// Displayable R, G, B over `window`; what lies outside the picture is 0.
std::array<Grid, 3> displayable_planes(const ColourImage& picture, const Window& window);

// Rec. 709 luma 0.2126 R' + 0.7152 G' + 0.0722 B' of the displayable, sRGB-encoded picture; 0..1.
Grid display_luma(const ColourImage& picture, const Window& window);

// Throws Error(usage): there is nothing to measure in an empty window.
void require_pixels(const Window& window);

// Mean of a map over a part of its window. The sum does not depend on the number of threads.
double mean(const Plane& map, const Window& part);

}  // namespace pullfocus
