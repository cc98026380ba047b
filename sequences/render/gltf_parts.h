// The steps of load_gltf(), in their order. Each throws Damaged.
#pragma once

#include <vector>

#include "render/gltf_accessor.h"
#include "render/scene.h"

namespace pullfocus::sequences {

// What no scene can be made of: extensions the file cannot do without, and compression.
void refuse_unsupported(const tinygltf::Model& model);

void read_textures(const tinygltf::Model& model, Scene& scene);  // one a glTF texture

Material read_material(const tinygltf::Model& model, int material);  // -1: the default one

// Meshes by glTF mesh, one a primitive: indices into scene.meshes.
std::vector<std::vector<int>> read_meshes(const tinygltf::Model& model, Scene& scene);

void read_lights(const tinygltf::Model& model, Scene& scene);

// Nodes of the default scene, parents first. `order` receives the new index of every glTF node, or -1.
void read_nodes(const tinygltf::Model& model, const std::vector<std::vector<int>>& meshes, Scene& scene,
                std::vector<int>& order);

void read_animations(const tinygltf::Model& model, const std::vector<int>& order, Scene& scene);

// For tinygltf: decodes pictures of files of their own, and leaves those in buffers, whose bounds it does not check, to
// read_textures().
bool load_picture(tinygltf::Image* image, const int index, std::string* error, std::string* warning, int width,
                  int height, const unsigned char* bytes, int size, void* user);

// Every number of a list that the format wants `size` long, finite and below 1e18; `fallback` if the list is empty.
template <class Vector>
Vector fixed_vector(const std::vector<double>& list, Vector fallback, const char* what) {
  if (list.empty()) return fallback;
  if (list.size() != static_cast<std::size_t>(Vector::length()))
    throw Damaged(std::string(what) + " has the wrong length");
  Vector result(0);
  for (int i = 0; i < Vector::length(); ++i) {
    const double value = list[static_cast<std::size_t>(i)];
    if (!(value > -1e18 && value < 1e18)) throw Damaged(std::string(what) + " holds NaN or a huge number");
    result[i] = static_cast<float>(value);
  }
  return result;
}

}  // namespace pullfocus::sequences
