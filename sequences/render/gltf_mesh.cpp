#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/gltf_parts.h"

namespace pullfocus::sequences {
namespace {

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

void refuse_unsupported(const tinygltf::Primitive& primitive) {
  if (!primitive.targets.empty()) throw Damaged("morph targets are not supported");
  if (primitive.extensions.count("KHR_draco_mesh_compression"))
    throw Damaged("KHR_draco_mesh_compression is not supported: export without compression");
  if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
      primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN)
    throw Damaged("points and lines are not supported, only triangles");
}

void read_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive, Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  if (primitive.indices >= 0) {
    corners = read_indices(model, primitive.indices, mesh.positions.size());
  } else {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) corners.push_back(static_cast<std::uint32_t>(i));
  }
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return;
  }
  const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t swap = strip ? i % 2 : 0;
    mesh.triangles.push_back({strip ? corners[i] : corners[0], corners[i + 1 + swap], corners[i + 2 - swap]});
  }
}

template <class Vector>
std::vector<Vector> optional_vectors(const tinygltf::Model& model, int accessor, int components, std::size_t count) {
  std::vector<Vector> vectors;
  if (accessor < 0) return vectors;
  for (const glm::vec4& value : read_vectors(model, accessor, components)) vectors.emplace_back(value);
  if (vectors.size() != count) throw Damaged(fmt::format("accessor {} has not one element a vertex", accessor));
  return vectors;
}

Mesh read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  refuse_unsupported(primitive);
  Mesh mesh;
  const int positions = attribute(primitive, "POSITION");
  if (positions < 0) throw Damaged("a primitive has no POSITION");
  for (const glm::vec4& value : read_vectors(model, positions, 3)) mesh.positions.emplace_back(value);
  const std::size_t count = mesh.positions.size();
  mesh.normals = optional_vectors<glm::vec3>(model, attribute(primitive, "NORMAL"), 3, count);
  mesh.uvs = optional_vectors<glm::vec2>(model, attribute(primitive, "TEXCOORD_0"), 2, count);
  mesh.colours = optional_vectors<glm::vec3>(model, attribute(primitive, "COLOR_0"), 0, count);
  for (glm::vec3& normal : mesh.normals) {
    const float length = glm::length(normal);
    normal = length > 1e-12f && std::isfinite(length) ? normal / length : glm::vec3(0, 1, 0);
  }
  read_triangles(model, primitive, mesh);
  mesh.material = read_material(model, primitive.material);
  return mesh;
}

}  // namespace

std::vector<std::vector<int>> read_meshes(const tinygltf::Model& model, Scene& scene) {
  std::vector<std::vector<int>> meshes;
  std::size_t total = 0;
  for (const tinygltf::Mesh& from : model.meshes) {
    std::vector<int> indices;
    for (const tinygltf::Primitive& primitive : from.primitives) {
      indices.push_back(static_cast<int>(scene.meshes.size()));
      scene.meshes.push_back(read_primitive(model, primitive));
      total += scene.meshes.back().positions.size() + scene.meshes.back().triangles.size();
      if (total > most_elements) throw Damaged("has more vertices and triangles than can be held");
    }
    meshes.push_back(std::move(indices));
  }
  return meshes;
}

}  // namespace pullfocus::sequences
