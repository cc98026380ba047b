// Rays against triangles, through Embree 3.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

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

// A surface that a ray meets.
struct Surface {
  const Material* material = nullptr;
  float depth = 0;  // ray parameter
  glm::vec3 position{0};
  glm::vec3 normal{0}, facet_normal{0};  // unit length, on the ray's side
  glm::vec2 uv{0};
  glm::vec3 colour{1};
  float openness = 1;
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

  // The nearest surface beyond `from` and nearer than `to`, in ray parameters.
  bool nearest(const Ray& ray, float from, float to, Surface& surface) const;
  bool blocked(const glm::vec3& origin, const glm::vec3& direction, float to) const;

  const std::vector<PlacedMesh>& meshes() const noexcept { return meshes_; }
  std::vector<PlacedMesh>& meshes() noexcept { return meshes_; }  // of which only openness may change

 private:
  bool misses(const glm::vec3& origin, const glm::vec3& direction, float to) const noexcept;

  Device device_;
  std::vector<PlacedMesh> meshes_;
  RTCScene scene_ = nullptr;
  glm::vec3 low_, high_;  // a box around everything, a little larger than it need be
};

}  // namespace pullfocus::sequences
