#include "render/placing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "render/pose.h"

namespace pullfocus::sequences {

Box box_of(const std::vector<PlacedMesh>& meshes) {
  Box box;
  for (const PlacedMesh& mesh : meshes)
    for (const glm::vec3& p : mesh.positions) box.add(p);
  return box;
}

std::vector<PlacedMesh> place(const Shot& shot, const std::vector<char>& moves, bool moving,
                              const std::vector<glm::mat4>& world) {
  std::vector<PlacedMesh> meshes;
  for (std::size_t i = 0; i < shot.scene.nodes.size(); ++i) {
    if (shot.hidden[i] || (moves[i] != 0) != moving) continue;
    for (const int mesh : shot.scene.nodes[i].meshes)
      meshes.emplace_back(shot.scene.meshes[static_cast<std::size_t>(mesh)], world[i]);
  }
  return meshes;
}

std::vector<PlacedLight> place_lights(const Shot& shot, int frame, const std::vector<glm::mat4>& world) {
  std::vector<PlacedLight> lights;
  for (std::size_t i = 0; i < shot.scene.nodes.size(); ++i) {
    const Node& node = shot.scene.nodes[i];
    if (node.light < 0 || shot.hidden[i]) continue;
    const glm::vec3 forward = -glm::vec3(world[i][2]);
    const float length = glm::length(forward);
    lights.push_back({shot.scene.lights[static_cast<std::size_t>(node.light)], glm::vec3(world[i][3]),
                      length > 0 ? forward / length : glm::vec3(0, -1, 0)});
  }
  for (const KeyedLight& keyed : shot.lights) {
    lights.push_back(keyed.light);
    lights.back().direction = glm::normalize(keyed.light.direction);
    lights.back().light.intensity *= static_cast<float>(keyed.intensity.linear_at(frame));
  }
  return lights;
}

glm::mat4 outside(const Box& box, double vertical_fov) {
  const glm::vec3 centre = box.empty() ? glm::vec3(0) : 0.5f * (box.low + box.high);
  const float distance = 0.55f * box.diagonal() / std::sin(static_cast<float>(vertical_fov) / 2);
  const glm::vec3 eye = centre + distance * glm::normalize(glm::vec3(0.35f, 0.3f, 1));
  return glm::inverse(glm::lookAt(eye, centre, glm::vec3(0, 1, 0)));
}

Reach reach_of_moving(const Shot& shot, const std::vector<char>& moves) {
  Reach reach;
  if (std::ranges::none_of(moves, [](char flag) { return flag != 0; })) return reach;
  constexpr int most_frames = 1000;  // of longer shots, only these will reuse pixels
  const int last = std::min(shot.last_frame, shot.first_frame + most_frames - 1);
  reach.spans.resize(Reach::most_spans);
  for (int frame = shot.first_frame; frame <= last; ++frame) {
    const auto world = world_matrices(shot.scene, shot.animations, frame_time(shot, frame));
    reach.spans[static_cast<std::size_t>(span_of(shot, frame))].add(box_of(place(shot, moves, true, world)));
  }
  for (Box& box : reach.spans) {
    box = box.with_margin().with_margin();
    reach.all.add(box);
  }
  return reach;
}

int span_of(const Shot& shot, int frame) noexcept {
  const auto offset = static_cast<std::int64_t>(frame) - shot.first_frame;
  return static_cast<int>(offset * static_cast<std::int64_t>(Reach::most_spans) /
                          std::max(1, shot.last_frame - shot.first_frame + 1));
}

}  // namespace pullfocus::sequences
