#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "star/parts.h"
#include "star/procedural.h"

namespace pullfocus::sequences {
namespace {

constexpr int strings = 3;
constexpr float bulb_spacing = 0.083f, bulb_radius = 0.0085f;
constexpr float tile_mm = 26.0f;

struct Bulb {
  glm::vec2 centre{0};
  glm::vec3 radiance{0};
};

// Strings of lights hang in arcs.
float string_y(int string, float x) {
  const float span = 0.62f + 0.11f * static_cast<float>(string);
  const float t = 2 * fraction(x / span + 0.31f * static_cast<float>(string)) - 1;
  return 0.42f - 0.125f * static_cast<float>(string) - 0.085f * (1 - t * t);
}

// The only bulb of a string whose light reaches column x: bulbs are jittered, but each within its own cell.
Bulb bulb_at(int string, float x) {
  static constexpr glm::vec3 tints[] = {
      {1.0f, 0.52f, 0.18f}, {1.0f, 0.66f, 0.28f}, {0.95f, 0.12f, 0.16f}, {0.12f, 0.50f, 1.0f}, {0.18f, 0.9f, 0.35f}};
  const float shift = 0.37f * static_cast<float>(string);
  const int cell = static_cast<int>(std::floor(x / bulb_spacing + shift));
  const float jitter = 0.4f * (hash(cell, string, 11u) - 0.5f);
  const float bulb_x = (static_cast<float>(cell) + 0.5f + jitter - shift) * bulb_spacing;
  const float power = 4.0f + 80.0f * hash(cell, string, 12u) * hash(cell, string, 13u);
  const glm::vec3 tint = tints[static_cast<int>(hash(cell, string, 14u) * 5)];
  return {{bulb_x, string_y(string, bulb_x)}, tint * power};
}

struct Light {
  glm::vec3 seen{0};  // radiance of a bulb at this very place
  glm::vec3 shed{0};  // what bulbs nearby cast on the wall
};

Light light_at(glm::vec2 p) {
  Light light;
  for (int string = 0; string < strings; ++string) {
    const Bulb bulb = bulb_at(string, p.x);
    const float d = glm::distance(p, bulb.centre) / bulb_radius;
    if (d < 1) light.seen = bulb.radiance * (1.0f - 0.5f * d * d);
    light.shed += bulb.radiance * (0.05f / (1.0f + 0.3f * d * d) * (1 - ramp(0.5f, 2.9f, d)));
  }
  return light;
}

// Glazed tiles in running bond.
glm::vec3 tiles(glm::vec2 at) {
  const int row = static_cast<int>(std::floor(at.y));
  const float along = at.x + (row & 1 ? 0.5f : 0.0f);
  const glm::vec2 in = glm::vec2(fraction(along), fraction(at.y)) - 0.5f;
  if (std::max(std::abs(in.x), std::abs(in.y)) > 0.46f) return glm::vec3(0.012f);
  const float tone = hash(static_cast<int>(std::floor(along)), row, 21u);
  const glm::vec3 glaze = glm::mix(glm::vec3(0.012f, 0.05f, 0.10f), glm::vec3(0.05f, 0.16f, 0.19f), tone);
  const float bevel = 1.0f + 0.9f * (in.y - 0.4f * in.x);
  return glaze * (bevel * (0.75f + 0.5f * fractal_noise(at * 5.0f, 22u)));
}

}  // namespace

// 0.45 m at the left of a square picture, 0.9 m at the right.
float wall_depth_mm(float x) { return 600.0f / glm::clamp(1.0f - 0.667f * x, 0.25f, 2.0f); }

Surface wall(glm::vec2 p) {
  const float depth = wall_depth_mm(p.x);
  const Light light = light_at(p);
  if (light.seen != glm::vec3(0)) return {light.seen, depth};
  const glm::vec2 from_lamp = p - glm::vec2(-0.05f, 0.12f);
  const float lamp = 0.45f + 1.1f * std::exp(-6.0f * glm::dot(from_lamp, from_lamp));
  return {tiles(p * (depth * mm_per_picture_unit_and_mm / tile_mm)) * (lamp + light.shed), depth};
}

}  // namespace pullfocus::sequences
