// Shots made in memory: planes and points that glow by themselves, so that their pictures are known.
#pragma once

#include <functional>

#include "render/renderer.h"

namespace pullfocus::sequences::test {

// Nothing before a black sky. Camera at the origin, looking along -z; lens 50 mm f/2 on 36 mm, focus at 2 m.
Shot empty_shot();

// Adds a rectangle at z = -depth around (x, y), sides in metres, of this radiance; returns the mesh's index.
int add_rectangle(Shot& shot, float depth, glm::vec2 centre, glm::vec2 sides, glm::vec3 radiance);

// Adds one that fills the picture and more, with a smooth random texture of 0..1.
void add_textured_wall(Shot& shot, float depth, unsigned int seed);

void set_lens(Shot& shot, double focal_length_mm, double f_number, double focus_distance);

// Signed CoC diameter in pixels of a depth, by the library's formula.
double coc_diameter(const ShotRenderer& renderer, int width, int height, float depth);

// Root mean square of the differences of R, G and B over the pixels at least `margin` from the border.
double rms_difference(const ColourImage& a, const ColourImage& b, int margin);

}  // namespace pullfocus::sequences::test
