// Bounds-checked reading of a glTF model's numbers. All functions throw Damaged.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/vec4.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace pullfocus::sequences {

// What is wrong with a file; load_gltf() puts the file's name in front.
struct Damaged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::size_t most_elements = 100'000'000;  // vertices or indices in the file, and drawn

// list[index], or Damaged naming the kind of thing.
template <class List>
const auto& item(const List& list, int index, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size())
    throw Damaged(std::string(what) + " " + std::to_string(index) + " does not exist");
  return list[static_cast<std::size_t>(index)];
}

// Bytes of a buffer view.
struct Bytes {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};
Bytes view_bytes(const tinygltf::Model& model, int view);

// An accessor's elements as floats, up to four components, the rest 0; normalised integers become 0..1 or -1..1. All
// finite and below 1e18. `components` is what the element must have, 0 for any up to four.
std::vector<glm::vec4> read_vectors(const tinygltf::Model& model, int accessor, int components);
std::vector<float> read_scalars(const tinygltf::Model& model, int accessor);
// Unsigned integers, each below `limit`.
std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor, std::size_t limit);

}  // namespace pullfocus::sequences
