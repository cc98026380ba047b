#include "render/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace pullfocus::sequences {
namespace {

glm::quat quaternion(const glm::vec4& v) { return {v.w, v.x, v.y, v.z}; }

glm::vec4 vector(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

// Hermite spline of glTF 2.0, appendix C.5: tangents are per second.
glm::vec4 cubic(const Channel& channel, std::size_t key, float share, float span) {
  const glm::vec4& start = channel.values[3 * key + 1];
  const glm::vec4& out = channel.values[3 * key + 2];
  const glm::vec4& in = channel.values[3 * key + 3];
  const glm::vec4& end = channel.values[3 * key + 4];
  const float t = share, t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * start + span * (t3 - 2 * t2 + t) * out + (-2 * t3 + 3 * t2) * end +
         span * (t3 - t2) * in;
}

glm::vec4 value_at(const Channel& channel, double time) {
  const bool spline = channel.easing == Easing::cubic;
  const auto value = [&](std::size_t key) { return channel.values[spline ? 3 * key + 1 : key]; };
  const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), static_cast<float>(time));
  if (after == channel.times.begin()) return value(0);
  const auto key = static_cast<std::size_t>(after - channel.times.begin()) - 1;
  if (after == channel.times.end() || channel.easing == Easing::step) return value(key);
  const float span = *after - channel.times[key];
  const float share = static_cast<float>((time - static_cast<double>(channel.times[key])) / static_cast<double>(span));
  if (spline) return cubic(channel, key, share, span);
  if (channel.path == Path::rotation)
    return vector(glm::slerp(quaternion(value(key)), quaternion(value(key + 1)), share));
  return glm::mix(value(key), value(key + 1), share);
}

void apply(const Channel& channel, double time, Transform& transform) {
  const glm::vec4 value = value_at(channel, time);
  if (channel.path == Path::translation) transform.translation = glm::vec3(value);
  if (channel.path == Path::scale) transform.scale = glm::vec3(value);
  if (channel.path == Path::rotation) {
    const glm::quat q = quaternion(value);
    const float length = glm::length(q);
    transform.rotation = length > 0 ? q / length : glm::quat(1, 0, 0, 0);
  }
}

glm::mat4 matrix(const Transform& t) {
  return glm::scale(glm::translate(glm::mat4(1), t.translation) * glm::mat4_cast(t.rotation), t.scale);
}

}  // namespace

std::vector<glm::mat4> world_matrices(const Scene& scene, const std::vector<int>& playing, double time) {
  std::vector<Transform> local;
  std::vector<char> animated(scene.nodes.size(), 0);
  for (const Node& node : scene.nodes) local.push_back(node.transform);
  for (const int index : playing)
    for (const Channel& channel : scene.animations[static_cast<std::size_t>(index)].channels) {
      apply(channel, time, local[static_cast<std::size_t>(channel.node)]);
      animated[static_cast<std::size_t>(channel.node)] = 1;
    }
  std::vector<glm::mat4> world(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const glm::mat4 own = node.matrix && !animated[i] ? *node.matrix : matrix(local[i]);
    world[i] = node.parent < 0 ? own : world[static_cast<std::size_t>(node.parent)] * own;
  }
  return world;
}

std::vector<char> moving_nodes(const Scene& scene, const std::vector<int>& playing) {
  std::vector<char> moving(scene.nodes.size(), 0);
  for (const int index : playing)
    for (const Channel& channel : scene.animations[static_cast<std::size_t>(index)].channels)
      moving[static_cast<std::size_t>(channel.node)] = 1;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    if (parent >= 0 && moving[static_cast<std::size_t>(parent)]) moving[i] = 1;
  }
  return moving;
}

double duration(const Animation& animation) {
  float last = 0;
  for (const Channel& channel : animation.channels) last = std::max(last, channel.times.back());
  return static_cast<double>(last);
}

}  // namespace pullfocus::sequences
