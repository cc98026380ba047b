#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "star/parts.h"
#include "star/procedural.h"

namespace pullfocus::sequences {
namespace {

// The floor lies 30 picture units times mm below the eye: seen at p.y < 0, it is 30 / -p.y mm away.
constexpr float floor_drop = 30.0f;
constexpr float floor_nearest_mm = 60.0f;

float floor_depth_mm(float y) {
  return y < 0 ? std::max(floor_drop / -y, floor_nearest_mm) : std::numeric_limits<float>::infinity();
}

// Where the ball rests on the floor, stretched towards the camera and away, or it would be too thin to see.
float ball_shadow(const Layout& layout, glm::vec2 at) {
  const float ball_x = (ball_centre.x - furniture_shift(layout)) * ball_depth_mm;
  const glm::vec2 away((at.x - ball_x) / 8.0f, (at.y - ball_depth_mm - 2.0f) / 6.0f);
  return 1.0f - 0.8f * std::exp(-glm::dot(away, away));
}

// Planks that run away from the camera. `at` is a place on the floor: sideways, and depth in mm.
glm::vec3 planks(glm::vec2 at) {
  const float column = at.x / 9.0f;
  const int index = static_cast<int>(std::floor(column));
  const float length = at.y / 70.0f + 7.0f * hash(index, 0, 41u);
  const float tone = 0.5f + hash(index, static_cast<int>(std::floor(length)), 42u);
  const float grain = 0.6f + 0.8f * fractal_noise({at.x * 0.9f, at.y * 0.07f}, 43u);
  const float gap = fraction(column) < 0.04f || fraction(length) < 0.02f ? 0.25f : 1.0f;
  const float falloff = 0.25f + 0.75f * std::exp(-std::max(at.y - 80.0f, 0.0f) / 160.0f);
  return glm::vec3(0.30f, 0.135f, 0.05f) * (tone * grain * gap * falloff);
}

}  // namespace

Surface backdrop(const Layout& layout, glm::vec2 p) {
  if (const auto hit = furniture(layout, p)) return *hit;
  const float depth = floor_depth_mm(p.y);
  if (depth >= wall_depth_mm(p.x)) return wall(p);
  const glm::vec2 at(p.x * depth, depth);
  return {planks(at) * ball_shadow(layout, at), depth};
}

}  // namespace pullfocus::sequences
