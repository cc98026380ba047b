#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/gltf_parts.h"

namespace pullfocus::sequences {
namespace {

constexpr int largest_picture = 16384;  // pixels a side

float linear(unsigned char encoded) {  // IEC 61966-2-1
  static const auto table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < 256; ++i) {
      const double v = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table[encoded];
}

Wrap wrap_mode(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

// The picture's pixels, decoded now where it lies in a buffer.
tinygltf::Image decoded(const tinygltf::Model& model, int index) {
  tinygltf::Image image = item(model.images, index, "picture");
  if (image.bufferView >= 0) {
    const Bytes bytes = view_bytes(model, image.bufferView);
    std::string error, warning;
    if (bytes.size == 0 || bytes.size > 0x7fffffffu ||
        !tinygltf::LoadImageData(&image, index, &error, &warning, 0, 0, bytes.data, static_cast<int>(bytes.size),
                                 nullptr))
      throw Damaged(fmt::format("picture {} cannot be decoded: it must be PNG or JPEG", index));
  }
  if (image.image.empty())
    throw Damaged(fmt::format("picture {} ('{}') cannot be read: it must be PNG or JPEG", index, image.uri));
  const bool plain = image.width > 0 && image.height > 0 && image.width <= largest_picture &&
                     image.height <= largest_picture && image.component == 4 && (image.bits == 8 || image.bits == 16);
  const std::size_t pixels =
      static_cast<std::size_t>(std::max(image.width, 0)) * static_cast<std::size_t>(std::max(image.height, 0));
  if (!plain || image.image.size() != pixels * 4 * static_cast<std::size_t>(image.bits / 8))
    throw Damaged(fmt::format("picture {} cannot be used: it must be PNG or JPEG of at most {} pixels a side", index,
                              largest_picture));
  return image;
}

int checked_texture(const tinygltf::Model& model, int texture, int set) {
  if (texture < 0) return -1;
  item(model.textures, texture, "texture");
  if (set != 0) throw Damaged(fmt::format("texture {} uses TEXCOORD_{}: only TEXCOORD_0 is supported", texture, set));
  return texture;
}

void refuse_transform(const tinygltf::ExtensionMap& extensions) {
  if (extensions.count("KHR_texture_transform"))
    throw Damaged("KHR_texture_transform is not supported: bake it into UVs");
}

float share(double value, const char* what) {
  if (!(value >= 0 && value <= 1)) throw Damaged(fmt::format("{} is not within 0 .. 1", what));
  return static_cast<float>(value);
}

float emissive_strength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  if (extension == material.extensions.end() || !extension->second.IsObject() ||
      !extension->second.Has("emissiveStrength"))
    return 1;
  const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
  const double value = strength.IsNumber() ? strength.GetNumberAsDouble() : -1;
  if (!(value >= 0 && value < 1e18)) throw Damaged("emissiveStrength is not a number >= 0");
  return static_cast<float>(value);
}

}  // namespace

bool load_picture(tinygltf::Image* image, const int index, std::string* error, std::string* warning, int width,
                  int height, const unsigned char* bytes, int size, void* user) {
  if (image->bufferView >= 0) return true;
  return tinygltf::LoadImageData(image, index, error, warning, width, height, bytes, size, user);
}

void read_textures(const tinygltf::Model& model, Scene& scene) {
  for (const tinygltf::Texture& from : model.textures) {
    const tinygltf::Image image = decoded(model, from.source);
    Texture texture{image.width, image.height, Wrap::repeat, Wrap::repeat, {}};
    if (from.sampler >= 0) {
      const tinygltf::Sampler& sampler = item(model.samplers, from.sampler, "sampler");
      texture.wrap_u = wrap_mode(sampler.wrapS);
      texture.wrap_v = wrap_mode(sampler.wrapT);
    }
    const std::size_t bytes = static_cast<std::size_t>(image.bits / 8);
    const std::size_t high = bytes - 1;  // of 16 bits, little-endian, the upper 8
    for (std::size_t i = 0; i < image.image.size(); i += 4 * bytes)
      texture.texels.emplace_back(linear(image.image[i + high]), linear(image.image[i + bytes + high]),
                                  linear(image.image[i + 2 * bytes + high]));
    scene.textures.push_back(std::move(texture));
  }
}

Material read_material(const tinygltf::Model& model, int index) {
  if (index < 0) return {};
  const tinygltf::Material& from = item(model.materials, index, "material");
  if (from.alphaMode != "OPAQUE")
    throw Damaged(fmt::format("material {}: alpha mode {} is not supported, only OPAQUE", index, from.alphaMode));
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  refuse_transform(pbr.baseColorTexture.extensions);
  refuse_transform(from.emissiveTexture.extensions);
  Material material;
  material.base_colour = glm::vec3(fixed_vector(pbr.baseColorFactor, glm::vec4(1), "baseColorFactor"));
  material.base_texture = checked_texture(model, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord);
  material.emission = fixed_vector(from.emissiveFactor, glm::vec3(0), "emissiveFactor") * emissive_strength(from);
  material.emission_texture = checked_texture(model, from.emissiveTexture.index, from.emissiveTexture.texCoord);
  material.metallic = share(pbr.metallicFactor, "metallicFactor");
  material.roughness = share(pbr.roughnessFactor, "roughnessFactor");
  return material;
}

}  // namespace pullfocus::sequences
