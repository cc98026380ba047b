// The surfaces of star-lateral, each a function of a position in picture units (see star_lateral.h). Colours
// are scene-linear, depths planar in millimetres.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace pullfocus::sequences {

// Film side 16/7 mm at 10 mm behind the lens: at depth d mm, one picture unit is this times d mm long.
inline constexpr float mm_per_picture_unit_and_mm = 16.0f / 70.0f;

struct Surface {
  glm::vec3 colour{0};
  float depth_mm = 0;
};

// What depends on the shape of the picture.
struct Layout {
  float half_width = 0.5f;  // of the picture; more than 0.5 where it is wider than high
};

// The room behind the star: hit by every ray, 60 mm to 2.4 m away.
Surface backdrop(const Layout& layout, glm::vec2 p);

// Its parts. Furniture moves outwards with the sides of a wide picture.
inline float furniture_shift(const Layout& layout) { return 0.55f * (layout.half_width - 0.5f); }
inline constexpr glm::vec2 ball_centre{-0.30f, -0.295f};  // unshifted
inline constexpr float ball_depth_mm = 72.0f;
std::optional<Surface> furniture(const Layout& layout, glm::vec2 p);  // filing cabinet and ball
float wall_depth_mm(float x);                                         // slanted: depends on the column only
Surface wall(glm::vec2 p);                                            // tiles and strings of lights

// Twisted cord with a knot, from top to bottom in front of everything, 20 to 22 mm away.
std::optional<Surface> cord(glm::vec2 p);

// Where the star is and how it is turned.
struct StarPose {
  glm::vec2 centre{0};
  float angle = 0;  // radians, counter-clockwise
};

inline constexpr float star_radius = 0.13f;    // centre to tip
inline constexpr float star_depth_mm = 40.0f;  // in focus

// Five-pointed star of ten facets, all at one depth.
std::optional<glm::vec3> star_colour(const StarPose& pose, glm::vec2 p);

}  // namespace pullfocus::sequences
