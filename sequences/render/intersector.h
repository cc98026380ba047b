// Rays against triangles, through Embree 3.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "render/box.h"
#include "render/camera.h"
#include "render/scene.h"

namespace pullfocus::sequences {

// A mesh of the scene where it stands.
struct PlacedMesh {
  PlacedMesh(const Mesh& from, const glm::mat4& world);

  const Mesh* mesh;
  std::vector<glm::vec3> positions, normals;  // world space
  std::vector<float> openness;                // 0 .. 1 a vertex: share of the sky that nothing near hides; empty: 1
};

// A surface that a ray meets; without material: none.
struct Surface {
  const Material* material = nullptr;
  float depth = 0;  // ray parameter
  glm::vec3 position{0};
  glm::vec3 normal{0}, facet_normal{0};  // unit length, on the ray's side
  glm::vec2 uv{0};
  glm::vec3 colour{1};
  float openness = 1;
};

// From a surface towards a light.
struct ShadowRay {
  glm::vec3 origin{0}, direction{0};
  float to = 0;  // ray parameter
};

// Rays go in packets of at most this many. Which bits a ray gets may depend on the others in its packet, so packets
// must be made of the same rays whenever the same bits are wanted.
inline constexpr std::size_t packet_size = 16;
struct alignas(64) Mask {
  std::array<int, packet_size> lanes{};  // -1: do, 0: leave
};

using Device = std::shared_ptr<RTCDeviceTy>;
Device make_device();  // throws Error(usage) if Embree does not run here

// Immutable once made; any number of threads may ask. Gives the same bits however many made it.
class Intersector {
 public:
  // Throws Error(usage) if the meshes do not fit into memory.
  Intersector(const Device& device, std::vector<PlacedMesh> meshes);
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  // Of every ray in `mask` the nearest surface beyond ray parameter `from`, if it is nearer than surfaces[i].depth.
  void nearest(std::span<const Ray> rays, const Mask& mask, float from, std::span<Surface> surfaces) const;
  // Takes those that something blocks out of `mask`.
  void blocked(std::span<const ShadowRay> rays, Mask& mask) const;

  const std::vector<PlacedMesh>& meshes() const noexcept { return meshes_; }
  std::vector<PlacedMesh>& meshes() noexcept { return meshes_; }  // of which only openness may change
  const Box& box() const noexcept { return box_; }                // around everything, with a margin

 private:
  Device device_;
  std::vector<PlacedMesh> meshes_;
  RTCScene scene_ = nullptr;
  Box box_;
};

}  // namespace pullfocus::sequences
