#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "star/parts.h"
#include "star/procedural.h"

namespace pullfocus::sequences {
namespace {

constexpr float notch_radius = 0.42f;  // tips are at 1
constexpr float centre_height = 0.34f;
constexpr float step = glm::two_pi<float>() / 5;

const glm::vec2 notch(notch_radius* std::sin(step / 2), notch_radius* std::cos(step / 2));
const glm::vec3 light = glm::normalize(glm::vec3(-0.5f, 0.7f, 0.75f));
constexpr glm::vec3 gold{1.0f, 0.62f, 0.14f};

// Normal of the one facet described at Place.
const glm::vec3 raised_centre(0, 0, centre_height);
const glm::vec3 upright_normal =
    glm::normalize(glm::cross(glm::vec3(notch, 0) - raised_centre, glm::vec3(0, 1, 0) - raised_centre));

glm::vec2 turned(glm::vec2 p, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

// A facet is the triangle centre, tip, notch. All ten are turned or mirrored images of the one from the upper
// tip, at (0, 1), to the notch right of it: `folded` is where a place of the star lies in that one.
struct Place {
  glm::vec2 folded{0};
  float turn = 0;  // radians, from the facet's tip to the upper one
  bool mirrored = false;
};

Place fold(glm::vec2 q) {
  const float turn = std::round(std::atan2(q.x, q.y) / step) * step;
  const glm::vec2 upright = turned(q, turn);
  return {{std::abs(upright.x), upright.y}, turn, upright.x < 0};
}

// How far inside the outline: 0 on the edge from tip to notch, 1 at the centre, negative outside.
float inwardness(glm::vec2 folded) {
  const glm::vec2 edge = notch - glm::vec2(0, 1);
  return 1 - folded.y + folded.x * edge.y / edge.x;
}

// Normal of the facet at a place, turned to where it is in the picture.
glm::vec3 facet_normal(const Place& place, float angle) {
  const glm::vec2 sideways(place.mirrored ? -upright_normal.x : upright_normal.x, upright_normal.y);
  return {turned(sideways, angle - place.turn), upright_normal.z};
}

}  // namespace

std::optional<glm::vec3> star_colour(const StarPose& pose, glm::vec2 p) {
  const glm::vec2 q = turned(p - pose.centre, -pose.angle) / star_radius;
  if (glm::dot(q, q) > 1) return std::nullopt;
  const Place place = fold(q);
  const float inside = inwardness(place.folded);
  if (inside < 0) return std::nullopt;

  const glm::vec3 normal = facet_normal(place, pose.angle);
  const float facing = glm::dot(normal, light);
  const float diffuse = std::max(facing, 0.0f);
  const float gleam = std::pow(std::max(2 * facing * normal.z - light.z, 0.0f), 12.0f);
  const float brushed = 0.82f + 0.36f * noise(place.folded * glm::vec2(60, 7), 71u);
  const float bevel = inside < 0.09f ? 1.35f : 1.0f;
  return gold * ((0.10f + 0.95f * diffuse) * brushed * bevel) + glm::vec3(1.0f, 0.9f, 0.7f) * (0.9f * gleam);
}

}  // namespace pullfocus::sequences
