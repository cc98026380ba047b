#include "render/shading.h"

#include <algorithm>
#include <array>
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

// What one of the rays of a packet sees.
struct Seen {
  Reflection reflection;
  glm::vec3 mirrored{0};
};

// Light from one lamp. Shadow rays are spared where the lamp gives nothing: behind the surface, out of the spot's cone.
void add_direct(const World& world, const PlacedLight& light, std::span<const Surface> surfaces,
                std::span<const Seen> seen, std::span<glm::vec3> radiance, Touch& touch) {
  std::array<Arrival, packet_size> from;
  std::array<ShadowRay, packet_size> rays;
  Mask lit;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    if (surface.material == nullptr) continue;
    from[i] = arrival(light, surface.position);
    const glm::vec3& towards = from[i].towards;
    if (!(glm::dot(surface.normal, towards) > 0) || !(glm::dot(surface.facet_normal, towards) > 0)) continue;
    if (from[i].irradiance == glm::vec3(0)) continue;
    lit.lanes[i] = -1;
    rays[i] = {surface.position + world.shadow_offset * surface.facet_normal, towards,
               from[i].distance - 2 * world.shadow_offset};
  }
  if (light.light.casts_shadow) world.blocked(std::span(rays).first(surfaces.size()), lit, touch);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (lit.lanes[i] == 0) continue;
    const Reflection& r = seen[i].reflection;
    const float slant = glm::dot(surfaces[i].normal, from[i].towards);
    const float aligned = glm::dot(seen[i].mirrored, from[i].towards);
    const float lobe = aligned > 0 ? std::pow(aligned, r.exponent) : 0;
    radiance[i] += from[i].irradiance * slant * (r.diffuse / pi + r.specular * (lobe * (r.exponent + 2) / (2 * pi)));
  }
}

}  // namespace

glm::vec3 Sky::radiance(const glm::vec3& direction) const noexcept {
  const float height = direction.y / std::max(glm::length(direction), 1e-12f);
  return height >= 0 ? glm::mix(horizon, top, std::sqrt(height)) : glm::mix(horizon, bottom, std::sqrt(-height));
}

bool World::near_moving(const glm::vec3& origin, const glm::vec3& direction, float to, Touch& touch) const {
  const glm::vec3 inverse = 1.0f / direction;
  if (touch.reach != nullptr && !touch.now && !touch.reach->all.missed_by(origin, inverse, to)) {
    for (std::size_t i = 0; i < touch.reach->spans.size(); ++i)
      if (!touch.reach->spans[i].missed_by(origin, inverse, to)) touch.spans |= std::uint32_t{1} << i;
  }
  if (moving->box().missed_by(origin, inverse, to)) return false;
  touch.now = true;
  return true;
}

void World::nearest(std::span<const Ray> rays, float from, std::span<Surface> surfaces, Touch& touch) const {
  Mask all;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    surfaces[i].material = nullptr;
    surfaces[i].depth = infinite;
    all.lanes[i] = -1;
  }
  still->nearest(rays, all, from, surfaces);
  Mask near;
  bool any = false;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!near_moving(rays[i].origin, rays[i].direction, surfaces[i].depth, touch)) continue;
    near.lanes[i] = -1;
    any = true;
  }
  if (any) moving->nearest(rays, near, from, surfaces);
}

void World::blocked(std::span<const ShadowRay> rays, Mask& mask, Touch& touch) const {
  const auto any = [&](const Mask& m) { return std::ranges::any_of(m.lanes, [](int lane) { return lane != 0; }); };
  Mask asked;  // no ray at all: lights inside a surface
  for (std::size_t i = 0; i < rays.size(); ++i) asked.lanes[i] = mask.lanes[i] != 0 && rays[i].to > 0 ? -1 : 0;
  if (!any(asked)) return;
  Mask open = asked;
  still->blocked(rays, open);
  Mask near;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (open.lanes[i] != 0 && near_moving(rays[i].origin, rays[i].direction, rays[i].to, touch)) near.lanes[i] = -1;
  }
  const Mask before = near;
  if (any(near)) moving->blocked(rays, near);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (asked.lanes[i] != 0 && (open.lanes[i] == 0 || before.lanes[i] != near.lanes[i])) mask.lanes[i] = 0;
}

void shade(const World& world, const Lighting& lighting, std::span<const Ray> rays, std::span<const Surface> surfaces,
           std::span<glm::vec3> radiance, Touch& touch) {
  std::array<Seen, packet_size> seen;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Surface& surface = surfaces[i];
    if (surface.material == nullptr) {
      radiance[i] = lighting.sky.radiance(rays[i].direction);
      continue;
    }
    const Reflection r = reflection(world, surface);
    const glm::vec3 mirrored = glm::reflect(glm::normalize(rays[i].direction), surface.normal);
    const float up = 0.5f + 0.5f * surface.normal.y;
    seen[i] = {r, mirrored};
    radiance[i] = surface.openness * (r.diffuse * glm::mix(lighting.ambient_bottom, lighting.ambient_top, up) +
                                      r.specular * r.gloss * lighting.sky.radiance(mirrored));
    const Material& material = *surface.material;
    if (material.emission != glm::vec3(0))
      radiance[i] += material.emission * textured(world, material.emission_texture, surface.uv);
  }
  for (const PlacedLight& light : lighting.lights)
    add_direct(world, light, surfaces, std::span(seen).first(surfaces.size()), radiance, touch);
}

}  // namespace pullfocus::sequences
