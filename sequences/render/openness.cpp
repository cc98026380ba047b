#include "render/openness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/sampling.h"

namespace pullfocus::sequences {
namespace {

constexpr int directions = 32;

float openness_at(const World& world, const glm::vec3& position, const glm::vec3& normal, float reach,
                  const SamplePattern& pattern, std::uint32_t seed) {
  const glm::vec3 side = std::abs(normal.x) > 0.6f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(side, normal)), v = glm::cross(normal, u);
  const glm::vec3 start = position + 4 * world.shadow_offset * normal;
  std::ptrdiff_t open = 0;
  Touch touch;
  for (std::size_t first = 0; first < pattern.size(); first += packet_size) {
    std::array<ShadowRay, packet_size> rays;
    Mask mask;
    const std::size_t count = std::min(packet_size, pattern.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec2 p = concentric_disc(pattern.lens(first + i, seed));  // projected hemisphere: cosine-weighted
      const float height = std::sqrt(std::max(0.0f, 1 - glm::dot(p, p)));
      rays[i] = {start, p.x * u + p.y * v + height * normal, reach};
      mask.lanes[i] = -1;
    }
    world.blocked(std::span(rays).first(count), mask, touch);
    open += std::ranges::count(mask.lanes, -1);
  }
  return static_cast<float>(open) / static_cast<float>(pattern.size());
}

}  // namespace

std::vector<float> openness(const World& world, const PlacedMesh& mesh, float reach) {
  if (mesh.normals.empty()) return {};
  const SamplePattern pattern(directions);
  std::vector<float> result(mesh.positions.size(), 1.0f);
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t i) {
    result[i] =
        openness_at(world, mesh.positions[i], mesh.normals[i], reach, pattern, hash(static_cast<std::uint32_t>(i)));
  });
  return result;
}

}  // namespace pullfocus::sequences
