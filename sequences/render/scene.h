// A scene in memory: what a glTF 2.0 file holds, and nothing of how it is drawn. Right-handed, y up; cameras look along
// their -z; lengths in metres, angles in radians, colours scene-linear.
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace pullfocus::sequences {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

// Linear RGB, rows top to bottom, u to the right and v down as in glTF.
struct Texture {
  int width = 0, height = 0;  // pixels, >= 1
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  std::vector<glm::vec3> texels;
};

struct Material {
  glm::vec3 base_colour{1};
  int base_texture = -1;  // index into Scene::textures, or -1
  glm::vec3 emission{0};  // radiance
  int emission_texture = -1;
  float metallic = 1, roughness = 1;  // 0 .. 1
};

// Triangles with one material. Arrays are of one length each, or empty where the file has none.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit length; empty: flat
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec3> colours;  // factors of the base colour
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Material material;
};

enum class LightKind : std::uint8_t { directional, point, spot };

// As in KHR_lights_punctual: lux for directional lights, candela for the others. Shines along -z of its node.
struct Light {
  LightKind kind = LightKind::directional;
  glm::vec3 intensity{1};
  float inner_cone = 0, outer_cone = 0.785398f;  // of spots
  bool casts_shadow = true;
  bool operator==(const Light&) const = default;
};

struct Transform {
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
};

struct Node {
  std::string name;
  int parent = -1;                  // its index is smaller than the node's own
  Transform transform;              // relative to the parent
  std::optional<glm::mat4> matrix;  // instead of `transform`
  std::vector<int> meshes;          // indices into Scene::meshes
  int light = -1;                   // index into Scene::lights
  bool is_camera = false;
  double vertical_fov = 0;  // of a camera
};

enum class Path : std::uint8_t { translation, rotation, scale };
enum class Easing : std::uint8_t { step, linear, cubic };

struct Channel {
  int node = 0;
  Path path = Path::translation;
  Easing easing = Easing::linear;
  std::vector<float> times;       // seconds, ascending, at least one
  std::vector<glm::vec4> values;  // one a time; of cubic splines three: in-tangent, value, out-tangent
};

struct Animation {
  std::string name;
  std::vector<Channel> channels;
};

struct Scene {
  std::vector<Texture> textures;
  std::vector<Mesh> meshes;
  std::vector<Light> lights;
  std::vector<Node> nodes;  // parents before their children
  std::vector<Animation> animations;
};

}  // namespace pullfocus::sequences
