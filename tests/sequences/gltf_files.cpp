#include "gltf_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "exr_files.h"
#include "imageio/picture.h"

namespace pullfocus::sequences::test {
namespace {

using exr::test::write_bytes;

template <class Number>
void append(std::string& bytes, std::initializer_list<Number> numbers) {
  for (const Number number : numbers) {
    char raw[sizeof(Number)];
    std::memcpy(raw, &number, sizeof(Number));
    bytes.append(raw, sizeof(Number));
  }
}

}  // namespace

GltfText small_gltf() {
  GltfText file;
  append<float>(file.bin, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});      // 0: positions
  append<float>(file.bin, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});          // 48: normals
  append<float>(file.bin, {0, 1, 1, 1, 1, 0, 0, 0});                      // 96: texture coordinates
  append<std::uint16_t>(file.bin, {0, 1, 2, 0, 2, 3});                    // 128: indices
  append<float>(file.bin, {0, 1});                                        // 140: times
  append<float>(file.bin, {0, 0, -3, 1, 0, -3});                          // 148: translations
  append<float>(file.bin, {0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f});  // 172: rotations
  file.json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2,3]}],
"extensionsUsed":["KHR_lights_punctual","KHR_materials_emissive_strength"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":20,"color":[1,0.5,0.25]}]}},
"nodes":[{"name":"Square","translation":[0,0,-3],"children":[1]},{"name":"Child","mesh":0,"scale":[0.5,0.5,0.5]},
{"name":"Camera","camera":0},{"name":"Lamp","translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.6,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,0.5,1],"metallicFactor":0,"baseColorTexture":{"index":0}},
"emissiveFactor":[0.25,0,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":2}}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],"images":[{"uri":"picture.png"}],
"animations":[{"name":"move","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},
{"sampler":1,"target":{"node":0,"path":"rotation"}}],
"samplers":[{"input":4,"output":5},{"input":4,"output":6,"interpolation":"STEP"}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":5,"componentType":5126,"count":2,"type":"VEC3"},{"bufferView":6,"componentType":5126,"count":2,"type":"VEC4"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48},
{"buffer":0,"byteOffset":96,"byteLength":32},{"buffer":0,"byteOffset":128,"byteLength":12},
{"buffer":0,"byteOffset":140,"byteLength":8},{"buffer":0,"byteOffset":148,"byteLength":24},
{"buffer":0,"byteOffset":172,"byteLength":32}],
"buffers":[{"uri":"scene.bin","byteLength":204}]})";
  return file;
}

GltfText with_embedded_picture(const GltfText& file, const std::string& png) {
  GltfText result = file;
  result.json = replaced(result.json, R"({"uri":"picture.png"})", R"({"bufferView":7,"mimeType":"image/png"})");
  result.json =
      replaced(result.json, R"("byteLength":32}],)",
               fmt::format(R"("byteLength":32}},{{"buffer":0,"byteOffset":204,"byteLength":{}}}],)", png.size()));
  result.bin += png;
  result.bin.resize((result.bin.size() + 3) / 4 * 4);
  result.json = replaced(result.json, R"("byteLength":204)", fmt::format(R"("byteLength":{})", result.bin.size()));
  return result;
}

std::string as_glb(const GltfText& file) {
  std::string json = replaced(file.json, R"("uri":"scene.bin",)", "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  const auto size = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
  append<std::uint32_t>(bytes, {2u, 28 + size(json) + size(file.bin), size(json), 0x4E4F534Au});
  bytes += json;
  append<std::uint32_t>(bytes, {size(file.bin), 0x004E4942u});
  return bytes + file.bin;
}

std::string write_gltf(const std::string& folder, const GltfText& file) {
  write_bytes(folder + "/scene.gltf", file.json);
  write_bytes(folder + "/scene.bin", file.bin);
  imageio::Picture picture{2, 2, {1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1}};
  imageio::write_picture(folder + "/picture.png", picture);
  return folder + "/scene.gltf";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace pullfocus::sequences::test
