// Colour of a surface: textured Lambert and Phong with emission. It depends on the surface and the direction it is seen
// from alone, not on any random number, so that pinhole pictures and lens-sampled ones differ by depth of field only.
//
// Lights give hard shadows; the rest of the sky gives ambient light, dimmed by the surface's openness, and a plain
// reflection. The metallic-roughness model of glTF is mapped to Phong: diffuse = base (1 - metallic), specular =
// mix(0.04, base, metallic), exponent 2 / roughness^4 - 2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/intersector.h"

namespace pullfocus::sequences {

// Radiance of what lies at infinity, by direction: from the horizon up and down.
struct Sky {
  glm::vec3 bottom{0}, horizon{0}, top{0};

  glm::vec3 radiance(const glm::vec3& direction) const noexcept;  // any length
  bool operator==(const Sky&) const = default;
};

struct PlacedLight {
  Light light;
  glm::vec3 position{0}, direction{0, -1, 0};  // direction in which it shines, unit length
  bool operator==(const PlacedLight&) const = default;
};

struct Lighting {
  std::vector<PlacedLight> lights;
  Sky sky;                   // as seen where nothing is, and in reflections
  glm::vec3 ambient_top{0};  // irradiance / pi on a surface facing up, and one facing down
  glm::vec3 ambient_bottom{0};
  bool operator==(const Lighting&) const = default;
};

// Where moving things go during a shot: a box for each of some spans of frames, and one around all.
struct Reach {
  static constexpr std::size_t most_spans = 32;
  Box all;
  std::vector<Box> spans;
};

// Which moving things some rays came near.
struct Touch {
  const Reach* reach = nullptr;  // null: spans do not matter
  bool now = false;              // those of this frame: otherwise, what the rays brought comes from still things alone
  std::uint32_t spans = 0;       // of the shot, a bit each; complete only unless `now`
};

// The things of one frame: those that stand still and those that move.
struct World {
  const Intersector* still = nullptr;
  const Intersector* moving = nullptr;
  const std::vector<Texture>* textures = nullptr;
  float shadow_offset = 0;  // of shadow rays from their surface, scene units

  // At most packet_size rays. Sets all surfaces; adds to `touch`.
  void nearest(std::span<const Ray> rays, float from, std::span<Surface> surfaces, Touch& touch) const;
  void blocked(std::span<const ShadowRay> rays, Mask& mask, Touch& touch) const;  // as Intersector::blocked

 private:
  bool near_moving(const glm::vec3& origin, const glm::vec3& direction, float to, Touch& touch) const;
};

// Radiance towards where at most packet_size rays come from, at the surfaces they meet, or of the sky.
void shade(const World& world, const Lighting& lighting, std::span<const Ray> rays, std::span<const Surface> surfaces,
           std::span<glm::vec3> radiance, Touch& touch);

}  // namespace pullfocus::sequences
