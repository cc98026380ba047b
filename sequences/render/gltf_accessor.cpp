#include "render/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pullfocus::sequences {
namespace {

struct Elements {
  const unsigned char* first = nullptr;
  std::size_t count = 0, stride = 0;
  int components = 0, type = 0;
  std::size_t component_bytes = 0;
  bool normalized = false;
};

std::size_t bytes_of(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      throw Damaged(fmt::format("component type {} is not one of glTF", component_type));
  }
}

int components_of(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      throw Damaged("an accessor of matrices is used where vectors are meant");
  }
}

Elements elements(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = item(model.accessors, index, "accessor");
  if (accessor.sparse.isSparse) throw Damaged(fmt::format("accessor {}: sparse accessors are not supported", index));
  if (accessor.bufferView < 0) throw Damaged(fmt::format("accessor {} has no buffer view", index));
  const Bytes view = view_bytes(model, accessor.bufferView);
  Elements e;
  e.count = accessor.count;
  e.components = components_of(accessor.type);
  e.type = accessor.componentType;
  e.component_bytes = bytes_of(accessor.componentType);
  e.normalized = accessor.normalized;
  const std::size_t size = e.component_bytes * static_cast<std::size_t>(e.components);
  const std::size_t given = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  e.stride = given == 0 ? size : given;
  const bool fits = e.count <= most_elements && e.stride >= size && e.stride <= 65536 &&
                    accessor.byteOffset <= view.size &&
                    (e.count == 0 || (e.count - 1) * e.stride + size <= view.size - accessor.byteOffset);
  if (!fits) throw Damaged(fmt::format("accessor {} reaches beyond its buffer view", index));
  e.first = view.data + accessor.byteOffset;
  return e;
}

template <class Number>
Number load(const unsigned char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(number));
  return number;
}

template <class Integer>
float converted(const unsigned char* bytes, bool normalized) {
  const float value = static_cast<float>(load<Integer>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<Integer>::max()), -1.0f);
}

float component(const Elements& e, const unsigned char* bytes) {
  switch (e.type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return converted<std::int8_t>(bytes, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return converted<std::uint8_t>(bytes, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return converted<std::int16_t>(bytes, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return converted<std::uint16_t>(bytes, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return converted<std::uint32_t>(bytes, e.normalized);
    default:
      return load<float>(bytes);
  }
}

std::uint32_t whole_number(const Elements& e, const unsigned char* bytes) {
  switch (e.type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(bytes);
    default:
      throw Damaged("indices are not unsigned integers");
  }
}

}  // namespace

Bytes view_bytes(const tinygltf::Model& model, int index) {
  const tinygltf::BufferView& view = item(model.bufferViews, index, "buffer view");
  const tinygltf::Buffer& buffer = item(model.buffers, view.buffer, "buffer");
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
    throw Damaged(fmt::format("buffer view {} reaches beyond its buffer of {} bytes", index, buffer.data.size()));
  if (view.extensions.count("EXT_meshopt_compression"))
    throw Damaged("EXT_meshopt_compression is not supported: export without compression");
  return {buffer.data.data() + view.byteOffset, view.byteLength};
}

std::vector<glm::vec4> read_vectors(const tinygltf::Model& model, int accessor, int components) {
  const Elements e = elements(model, accessor);
  if (components != 0 && e.components != components)
    throw Damaged(fmt::format("accessor {} has {} components instead of {}", accessor, e.components, components));
  std::vector<glm::vec4> values(e.count, glm::vec4(0));
  for (std::size_t i = 0; i < e.count; ++i)
    for (int c = 0; c < e.components; ++c) {
      const float value = component(e, e.first + i * e.stride + static_cast<std::size_t>(c) * e.component_bytes);
      if (!(std::abs(value) < 1e18f)) throw Damaged(fmt::format("accessor {} holds NaN or huge numbers", accessor));
      values[i][c] = value;
    }
  return values;
}

std::vector<float> read_scalars(const tinygltf::Model& model, int accessor) {
  std::vector<float> numbers;
  for (const glm::vec4& value : read_vectors(model, accessor, 1)) numbers.push_back(value.x);
  return numbers;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor, std::size_t limit) {
  const Elements e = elements(model, accessor);
  if (e.components != 1) throw Damaged(fmt::format("accessor {} of indices is not scalar", accessor));
  std::vector<std::uint32_t> values(e.count);
  for (std::size_t i = 0; i < e.count; ++i) {
    values[i] = whole_number(e, e.first + i * e.stride);
    if (values[i] >= limit) throw Damaged(fmt::format("index {} is beyond the last vertex", values[i]));
  }
  return values;
}

}  // namespace pullfocus::sequences
