#include "render/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>

#include "image/error.h"
#include "render/gltf_parts.h"

namespace pullfocus::sequences {
namespace {

constexpr const char* known_extensions[] = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                            "KHR_mesh_quantization"};
constexpr int deepest_json = 64;  // the parser works by recursion

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) throw Damaged("cannot be read; give a .gltf or .glb file");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() > 0x7fffffffu) throw Damaged("files of 2 GB and more are not supported");
  return bytes;
}

void check_nesting(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (in_string && json[i] == '\\') {
      ++i;
    } else if (json[i] == '"') {
      in_string = !in_string;
    } else if (!in_string) {
      if (json[i] == '[' || json[i] == '{') ++depth;
      if (json[i] == ']' || json[i] == '}') --depth;
      if (depth > deepest_json) throw Damaged("its JSON is nested too deeply");
    }
  }
}

// The JSON of a .glb follows a header of 20 bytes; what is wrong with those, the parser says.
std::string_view json_of(std::string_view bytes, bool binary) {
  if (!binary) return bytes;
  if (bytes.size() < 20) return {};
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
  return bytes.substr(20, byte(12) | byte(13) << 8 | byte(14) << 16 | byte(15) << 24);
}

std::string first_line(std::string text) {
  text.erase(std::min(text.find('\n'), text.size()));
  return text;
}

tinygltf::Model parse(const std::string& path) {
  const std::string bytes = read_file(path);
  const bool binary = bytes.starts_with("glTF");
  check_nesting(json_of(bytes, binary));
  const std::string folder = std::filesystem::path(path).parent_path().string();
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(load_picture, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool good =
      binary ? parser.LoadBinaryFromMemory(&model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
             : parser.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  if (!good) throw Damaged(error.empty() ? "is no glTF 2.0 file" : first_line(error));
  return model;
}

Scene convert(const tinygltf::Model& model) {
  refuse_unsupported(model);
  Scene scene;
  read_textures(model, scene);
  const auto meshes = read_meshes(model, scene);
  read_lights(model, scene);
  std::vector<int> order;
  read_nodes(model, meshes, scene, order);
  read_animations(model, order, scene);
  return scene;
}

[[noreturn]] void refuse(const std::string& path, std::string_view message) {
  throw Error(ErrorCode::unreadable, fmt::format("{}: {}", path, message));
}

}  // namespace

void refuse_unsupported(const tinygltf::Model& model) {
  for (const std::string& name : model.extensionsRequired)
    if (std::find(std::begin(known_extensions), std::end(known_extensions), name) == std::end(known_extensions))
      throw Damaged(fmt::format("needs the extension {}, which is not supported", name));
}

Scene load_gltf(const std::string& path) {
  try {
    return convert(parse(path));
  } catch (const Damaged& error) {
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, "does not fit into memory");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {  // of the JSON parser
    refuse(path, fmt::format("is no glTF 2.0 file: {}", first_line(error.what())));
  }
}

}  // namespace pullfocus::sequences
