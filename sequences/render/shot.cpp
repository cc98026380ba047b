#include "render/shot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/error.h"
#include "render/gltf.h"
#include "render/pose.h"
#include "render/shot_file.h"

namespace pullfocus::sequences {
namespace {

constexpr double pinhole_f_number = 1e6;
constexpr double default_vertical_fov = 0.7;

double vertical_fov(const Shot& shot, int node) {
  return node < 0 ? default_vertical_fov : shot.scene.nodes[static_cast<std::size_t>(node)].vertical_fov;
}

// Length of animation in frames, rounded up.
int last_frame(const Shot& shot) {
  double seconds = 0;
  for (const Animation& animation : shot.scene.animations) seconds = std::max(seconds, duration(animation));
  return shot.first_frame + static_cast<int>(std::ceil(std::min(seconds, 3600.0) * shot.fps));
}

Shot shot_of_scene(const std::string& path) {
  Shot shot;
  shot.name = std::filesystem::path(path).stem().string();
  shot.scene = load_gltf(path);
  shot.hidden.assign(shot.scene.nodes.size(), 0);
  for (std::size_t i = 0; i < shot.scene.animations.size(); ++i) shot.animations.push_back(static_cast<int>(i));
  shot.cameras.push_back({0, first_camera(shot.scene)});
  shot.last_frame = last_frame(shot);
  shot.sky = {glm::vec3(0.12f), glm::vec3(0.35f), glm::vec3(0.18f, 0.24f, 0.35f)};
  if (shot.scene.lights.empty()) {
    shot.ambient_top = glm::vec3(0.45f);
    shot.ambient_bottom = glm::vec3(0.2f);
    PlacedLight sun;
    sun.direction = glm::vec3(-0.48f, -0.72f, -0.5f);
    shot.lights.push_back({sun, KeyedValue(2.2, "light", Infinity::refused)});
  }
  return shot;
}

}  // namespace

int first_camera(const Scene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].is_camera) return static_cast<int>(i);
  return -1;
}

Shot load_shot(const std::string& path) {
  const std::string type = std::filesystem::path(path).extension().string();
  if (type == ".gltf" || type == ".glb") return shot_of_scene(path);
  return load_shot_file(path);
}

std::vector<std::string> shot_names(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string shot_path(const std::string& folder, std::string_view name) {
  for (const std::string& known : shot_names(folder))
    if (known == name) return folder + "/" + known + ".toml";
  return {};
}

FrameLens frame_lens(const Shot& shot, int frame, int width, int height) {
  const ShotLens& from = shot.lens;
  FrameLens result;
  ThinLens& lens = result.lens;
  lens.model = from.model;
  const double aspect = static_cast<double>(width) / height;
  lens.sensor_mm = from.sensor_is_height ? from.sensor_mm * aspect : from.sensor_mm;
  result.sensor_height_mm = lens.sensor_mm / aspect;
  lens.focal_length_mm = from.focal_length
                             ? from.focal_length->linear_at(frame)
                             : result.sensor_height_mm / 2 / std::tan(vertical_fov(shot, camera_node(shot, frame)) / 2);
  result.given = from.fstop && from.focus;
  lens.f_number = from.fstop ? from.fstop->linear_at(frame) : pinhole_f_number;
  lens.focus_distance =
      from.focus ? from.focus->focus_at(frame, from.interpolation) : std::numeric_limits<double>::infinity();
  validate(lens);
  return result;
}

int camera_node(const Shot& shot, int frame) {
  int node = shot.cameras.front().node;
  for (const CameraKey& key : shot.cameras)
    if (key.frame <= frame) node = key.node;
  return node;
}

double frame_time(const Shot& shot, int frame) { return (static_cast<double>(frame) - shot.first_frame) / shot.fps; }

}  // namespace pullfocus::sequences
