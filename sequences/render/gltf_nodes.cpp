#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/gltf_parts.h"

namespace pullfocus::sequences {
namespace {

float finite(double value, const char* what) {
  if (!(value > -1e18 && value < 1e18)) throw Damaged(fmt::format("{} is NaN or huge", what));
  return static_cast<float>(value);
}

glm::quat rotation(const std::vector<double>& list) {
  const glm::vec4 v = fixed_vector(list, glm::vec4(0, 0, 0, 1), "rotation");
  const float length = glm::length(v);
  if (!(length > 1e-12f && std::isfinite(length))) return {1, 0, 0, 0};
  return {v.w / length, v.x / length, v.y / length, v.z / length};
}

glm::mat4 read_matrix(const std::vector<double>& list) {
  if (list.size() != 16) throw Damaged("matrix has the wrong length");
  glm::mat4 matrix(1);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = finite(list[static_cast<std::size_t>(i)], "matrix");
  return matrix;
}

void read_camera(const tinygltf::Model& model, int camera, Node& node) {
  const tinygltf::Camera& from = item(model.cameras, camera, "camera");
  if (from.type != "perspective") throw Damaged(fmt::format("camera {}: only perspective ones are supported", camera));
  node.is_camera = true;
  node.vertical_fov = from.perspective.yfov;
  if (!(node.vertical_fov > 1e-4 && node.vertical_fov < 3.14)) throw Damaged("a camera's yfov is no angle below pi");
}

int read_light_index(const tinygltf::Model& model, const tinygltf::Node& node) {
  const auto extension = node.extensions.find("KHR_lights_punctual");
  if (extension == node.extensions.end() || !extension->second.IsObject() || !extension->second.Has("light")) return -1;
  const tinygltf::Value& light = extension->second.Get("light");
  const int index = light.IsNumber() ? light.GetNumberAsInt() : -1;
  item(model.lights, index, "light");
  return index;
}

Node read_node(const tinygltf::Model& model, const tinygltf::Node& from, const std::vector<std::vector<int>>& meshes) {
  if (from.skin >= 0) throw Damaged(fmt::format("node '{}': skins are not supported", from.name));
  if (from.extensions.count("EXT_mesh_gpu_instancing")) throw Damaged("EXT_mesh_gpu_instancing is not supported");
  Node node;
  node.name = from.name;
  node.transform.translation = fixed_vector(from.translation, glm::vec3(0), "translation");
  node.transform.rotation = rotation(from.rotation);
  node.transform.scale = fixed_vector(from.scale, glm::vec3(1), "scale");
  if (!from.matrix.empty()) node.matrix = read_matrix(from.matrix);
  if (from.mesh >= 0) node.meshes = item(meshes, from.mesh, "mesh");
  if (from.camera >= 0) read_camera(model, from.camera, node);
  node.light = read_light_index(model, from);
  return node;
}

std::vector<int> roots(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return item(model.scenes, std::max(model.defaultScene, 0), "scene").nodes;
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children) {
      item(model.nodes, child, "node");
      is_child[static_cast<std::size_t>(child)] = 1;
    }
  std::vector<int> result;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (!is_child[i]) result.push_back(static_cast<int>(i));
  return result;
}

std::vector<glm::vec4> read_values(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, Path path) {
  return read_vectors(model, sampler.output, path == Path::rotation ? 4 : 3);
}

Channel read_channel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                     const tinygltf::AnimationChannel& from) {
  Channel channel;
  if (from.target_path == "translation")
    channel.path = Path::translation;
  else if (from.target_path == "rotation")
    channel.path = Path::rotation;
  else if (from.target_path == "scale")
    channel.path = Path::scale;
  else
    throw Damaged(fmt::format("animation of '{}' is not supported", from.target_path));
  const tinygltf::AnimationSampler& sampler = item(animation.samplers, from.sampler, "animation sampler");
  if (sampler.interpolation == "STEP") channel.easing = Easing::step;
  if (sampler.interpolation == "CUBICSPLINE") channel.easing = Easing::cubic;
  channel.times = read_scalars(model, sampler.input);
  channel.values = read_values(model, sampler, channel.path);
  if (channel.times.empty()) throw Damaged("an animation sampler has no keys");
  for (std::size_t i = 1; i < channel.times.size(); ++i)
    if (!(channel.times[i] > channel.times[i - 1])) throw Damaged("an animation's times do not ascend");
  if (channel.values.size() != channel.times.size() * (channel.easing == Easing::cubic ? 3 : 1))
    throw Damaged("an animation sampler has not one value a key");
  return channel;
}

}  // namespace

void read_lights(const tinygltf::Model& model, Scene& scene) {
  for (const tinygltf::Light& from : model.lights) {
    Light light;
    if (from.type == "point")
      light.kind = LightKind::point;
    else if (from.type == "spot")
      light.kind = LightKind::spot;
    else if (from.type != "directional")
      throw Damaged(fmt::format("a light of type '{}' is not supported", from.type));
    light.intensity = fixed_vector(from.color, glm::vec3(1), "color") * finite(from.intensity, "intensity");
    light.inner_cone = finite(from.spot.innerConeAngle, "innerConeAngle");
    light.outer_cone = finite(from.spot.outerConeAngle, "outerConeAngle");
    scene.lights.push_back(light);
  }
}

void read_nodes(const tinygltf::Model& model, const std::vector<std::vector<int>>& meshes, Scene& scene,
                std::vector<int>& order) {
  order.assign(model.nodes.size(), -1);
  std::vector<std::pair<int, int>> open;  // glTF node, parent in scene.nodes
  for (const int root : roots(model)) open.emplace_back(root, -1);
  std::size_t triangles = 0;
  for (std::size_t next = 0; next < open.size(); ++next) {
    const auto [index, parent] = open[next];
    const tinygltf::Node& from = item(model.nodes, index, "node");
    if (order[static_cast<std::size_t>(index)] >= 0)
      throw Damaged(fmt::format("node {} has two parents or is its own ancestor", index));
    order[static_cast<std::size_t>(index)] = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(read_node(model, from, meshes));
    scene.nodes.back().parent = parent;
    for (const int mesh : scene.nodes.back().meshes)
      triangles += scene.meshes[static_cast<std::size_t>(mesh)].triangles.size();
    if (triangles > most_elements) throw Damaged("its nodes show more triangles than can be held");
    for (const int child : from.children) open.emplace_back(child, order[static_cast<std::size_t>(index)]);
  }
}

void read_animations(const tinygltf::Model& model, const std::vector<int>& order, Scene& scene) {
  for (const tinygltf::Animation& from : model.animations) {
    Animation animation{from.name, {}};
    for (const tinygltf::AnimationChannel& channel : from.channels) {
      if (channel.target_node < 0) continue;  // of an extension
      item(model.nodes, channel.target_node, "node");
      Channel read = read_channel(model, from, channel);
      read.node = order[static_cast<std::size_t>(channel.target_node)];
      if (read.node >= 0) animation.channels.push_back(std::move(read));
    }
    scene.animations.push_back(std::move(animation));
  }
}

}  // namespace pullfocus::sequences
