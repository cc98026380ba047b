#include "simple_shots.h"

#include <cmath>
#include <random>

namespace pullfocus::sequences::test {

Shot empty_shot() {
  Shot shot;
  shot.name = "test";
  Node camera;
  camera.name = "Camera";
  camera.is_camera = true;
  camera.vertical_fov = 0.4;
  shot.scene.nodes.push_back(camera);
  shot.cameras.push_back({0, 0});
  shot.hidden.push_back(0);
  set_lens(shot, 50, 2, 2);
  return shot;
}

int add_rectangle(Shot& shot, float depth, glm::vec2 centre, glm::vec2 sides, glm::vec3 radiance) {
  Mesh mesh;
  for (const glm::vec2 corner : {glm::vec2(-0.5f, -0.5f), {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}) {
    mesh.positions.emplace_back(centre + corner * sides, -depth);
    mesh.uvs.emplace_back(corner.x + 0.5f, 0.5f - corner.y);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material.base_colour = glm::vec3(0);
  mesh.material.metallic = 1;
  mesh.material.emission = radiance;
  Node node;
  node.name = "Rectangle";
  node.meshes.push_back(static_cast<int>(shot.scene.meshes.size()));
  shot.scene.meshes.push_back(mesh);
  shot.scene.nodes.push_back(node);
  shot.hidden.push_back(0);
  return node.meshes.front();
}

void add_textured_wall(Shot& shot, float depth, unsigned int seed) {
  std::mt19937 random(seed);
  Texture texture{64, 64, Wrap::repeat, Wrap::repeat, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const auto value = [&] { return static_cast<float>(random() % 1024) / 1024; };
    texture.texels.emplace_back(value(), value(), value());
  }
  const int mesh = add_rectangle(shot, depth, {0.013f * depth, -0.007f * depth}, glm::vec2(1.4f * depth), glm::vec3(1));
  shot.scene.meshes[static_cast<std::size_t>(mesh)].material.emission_texture =
      static_cast<int>(shot.scene.textures.size());
  shot.scene.textures.push_back(texture);
}

void set_lens(Shot& shot, double focal_length_mm, double f_number, double focus_distance) {
  shot.lens.focal_length = KeyedValue(focal_length_mm, "test", Infinity::refused);
  shot.lens.fstop = KeyedValue(f_number, "test", Infinity::refused);
  shot.lens.focus = KeyedValue(focus_distance, "test", Infinity::legal);
}

double coc_diameter(const ShotRenderer& renderer, int width, int height, float depth) {
  const auto coc = coc_function(renderer.lens(1).lens, {width, height}, DepthKind::planar);
  return static_cast<double>(coc(depth));
}

double rms_difference(const ColourImage& a, const ColourImage& b, int margin) {
  const Window w = grow(a.window(), -margin, -margin);
  double sum = 0;
  for (int y = w.y0; y < w.y1; ++y)
    for (int x = w.x0; x < w.x1; ++x)
      for (int c = 0; c < 3; ++c) {
        const double d = static_cast<double>(a.get(x, y, c)) - static_cast<double>(b.get(x, y, c));
        sum += d * d;
      }
  return std::sqrt(sum / (3 * static_cast<double>(w.pixels())));
}

}  // namespace pullfocus::sequences::test
