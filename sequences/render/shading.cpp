#include "render/shading.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "render/texture.h"

namespace pullfocus::sequences {
namespace {

constexpr float pi = 3.14159265f;
constexpr float infinite = std::numeric_limits<float>::infinity();

struct Reflection {
  glm::vec3 diffuse{0}, specular{0};
  float exponent = 1, gloss = 0;
};

// Light that arrives at a point, were nothing in its way.
struct Arrival {
  glm::vec3 irradiance{0};  // on a surface facing it
  glm::vec3 towards{0};     // unit length
  float distance = infinite;
};

glm::vec3 textured(const World& world, int texture, const glm::vec2& uv) {
  return texture < 0 ? glm::vec3(1) : texture_colour((*world.textures)[static_cast<std::size_t>(texture)], uv);
}

Reflection reflection(const World& world, const Surface& surface) {
  const Material& m = *surface.material;
  const glm::vec3 base = m.base_colour * surface.colour * textured(world, m.base_texture, surface.uv);
  const float roughness = std::max(m.roughness, 0.05f);
  const float alpha = roughness * roughness;
  return {base * (1 - m.metallic), glm::mix(glm::vec3(0.04f), base, m.metallic),
          std::max(2 / (alpha * alpha) - 2, 0.0f), (1 - roughness) * (1 - roughness)};
}

Arrival arrival(const PlacedLight& placed, const glm::vec3& position) {
  const Light& light = placed.light;
  if (light.kind == LightKind::directional) return {light.intensity, -placed.direction, infinite};
  const glm::vec3 way = placed.position - position;
  const float squared = std::max(glm::dot(way, way), 1e-12f);
  const float distance = std::sqrt(squared);
  Arrival result{light.intensity / squared, way / distance, distance};
  if (light.kind == LightKind::spot) {
    const float inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
    const float angle = -glm::dot(placed.direction, result.towards);
    const float share = std::clamp((angle - outer) / std::max(inner - outer, 1e-4f), 0.0f, 1.0f);
    result.irradiance *= share * share;
  }
  return result;
}

glm::vec3 direct(const World& world, const Lighting& lighting, const Surface& surface, const Reflection& r,
                 const glm::vec3& mirrored) {
  glm::vec3 sum(0);
  for (const PlacedLight& light : lighting.lights) {
    const Arrival from = arrival(light, surface.position);
    const float slant = glm::dot(surface.normal, from.towards);
    if (!(slant > 0) || !(glm::dot(surface.facet_normal, from.towards) > 0)) continue;
    if (light.light.casts_shadow && world.blocked(surface.position + world.shadow_offset * surface.facet_normal,
                                                  from.towards, from.distance - 2 * world.shadow_offset))
      continue;
    const float aligned = glm::dot(mirrored, from.towards);
    const float lobe = aligned > 0 ? std::pow(aligned, r.exponent) : 0;
    sum += from.irradiance * slant * (r.diffuse / pi + r.specular * (lobe * (r.exponent + 2) / (2 * pi)));
  }
  return sum;
}

}  // namespace

glm::vec3 Sky::radiance(const glm::vec3& direction) const noexcept {
  const float height = direction.y / std::max(glm::length(direction), 1e-12f);
  return height >= 0 ? glm::mix(horizon, top, std::sqrt(height)) : glm::mix(horizon, bottom, std::sqrt(-height));
}

bool World::nearest(const Ray& ray, float from, Surface& surface) const {
  const bool met = still->nearest(ray, from, infinite, surface);
  return moving->nearest(ray, from, met ? surface.depth : infinite, surface) || met;
}

bool World::blocked(const glm::vec3& origin, const glm::vec3& direction, float to) const {
  return still->blocked(origin, direction, to) || moving->blocked(origin, direction, to);
}

glm::vec3 shade(const World& world, const Lighting& lighting, const Surface& surface, const glm::vec3& view) {
  const Material& material = *surface.material;
  const Reflection r = reflection(world, surface);
  const glm::vec3 mirrored = glm::reflect(glm::normalize(view), surface.normal);
  const float up = 0.5f + 0.5f * surface.normal.y;
  glm::vec3 colour = surface.openness * (r.diffuse * glm::mix(lighting.ambient_bottom, lighting.ambient_top, up) +
                                         r.specular * r.gloss * lighting.sky.radiance(mirrored));
  colour += direct(world, lighting, surface, r, mirrored);
  return colour + material.emission * textured(world, material.emission_texture, surface.uv);
}

}  // namespace pullfocus::sequences
