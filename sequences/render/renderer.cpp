#include "render/renderer.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "render/openness.h"
#include "render/pose.h"
#include "render/sampling.h"

namespace pullfocus::sequences {
namespace {

constexpr float largest_half = 65504;
constexpr int tile = 16;               // pixels a side of a task
constexpr float same_surface = 1e-5f;  // hits nearer together than this share of their depth are one
constexpr std::size_t deepest = 1000;  // surfaces along a ray

struct Box {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};

  void add(const std::vector<PlacedMesh>& meshes) {
    for (const PlacedMesh& mesh : meshes)
      for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
  }
  bool empty() const { return !(low.x <= high.x); }
  float diagonal() const { return empty() ? 1 : glm::length(high - low); }
};

// Meshes of the nodes whose flag in `moves` is `moving`.
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

// Stands in front of everything, for scenes without a camera.
glm::mat4 outside(const Box& box, double vertical_fov) {
  const glm::vec3 centre = box.empty() ? glm::vec3(0) : 0.5f * (box.low + box.high);
  const float distance = 0.55f * box.diagonal() / std::sin(static_cast<float>(vertical_fov) / 2);
  const glm::vec3 eye = centre + distance * glm::normalize(glm::vec3(0.35f, 0.3f, 1));
  return glm::inverse(glm::lookAt(eye, centre, glm::vec3(0, 1, 0)));
}

template <class Work>
void for_pixels(const Raster& raster, const Work& work) {
  tbb::parallel_for(tbb::blocked_range2d<int>(0, raster.height, tile, 0, raster.width, tile),
                    [&](const tbb::blocked_range2d<int>& block) {
                      for (int y = block.rows().begin(); y < block.rows().end(); ++y)
                        for (int x = block.cols().begin(); x < block.cols().end(); ++x) work(x, y);
                    });
}

std::uint32_t pixel_seed(int x, int y) { return hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)); }

// Factor of mean about 1: what a path tracer's noise does to a pixel.
float noise_factor(double deviation, int x, int y, int frame) {
  float sum = 0;  // of twelve uniform numbers: variance 1
  for (std::uint32_t i = 0; i < 12; ++i)
    sum += static_cast<float>(hash(pixel_seed(x, y), static_cast<std::uint32_t>(frame), i)) * 0x1p-32f;
  return std::max(0.0f, 1 + static_cast<float>(deviation) * (sum - 6));
}

void store(ColourImage& image, int x, int y, const glm::vec3& colour) {
  for (int c = 0; c < 3; ++c) image.set(x, y, c, std::min(colour[c], largest_half));
  image.set(x, y, 3, 1.0f);
}

}  // namespace

struct ShotRenderer::Stage {
  Stage(const FrameCamera& frame_camera, std::unique_ptr<Intersector> moving_meshes)
      : camera(frame_camera), moving(std::move(moving_meshes)) {}

  glm::vec3 colour(const Ray& ray) const {
    Surface surface;
    return scale * (world.nearest(ray, 0, surface) ? shade(world, lighting, surface, ray.direction)
                                                   : lighting.sky.radiance(ray.direction));
  }

  // Mean colour of a pixel; on the lens or, if not `through_lens`, at its middle.
  glm::vec3 pixel(int x, int y, const SamplePattern& pattern, std::uint32_t seed, bool through_lens) const {
    glm::dvec3 sum(0);
    const glm::vec2 corner(x, y);
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      const glm::vec2 lens = through_lens ? concentric_disc(pattern.lens(i, seed)) : glm::vec2(0);
      sum += colour(camera.ray(corner + pattern.pixel(i, seed), lens));
    }
    return sum / static_cast<double>(pattern.size());
  }

  FrameCamera camera;
  std::unique_ptr<Intersector> moving;
  World world;
  Lighting lighting;
  float scale = 1;  // exposure
};

ShotRenderer::ShotRenderer(Shot shot, int width, int height)
    : shot_(std::move(shot)), raster_{width, height}, device_(make_device()) {
  moves_ = moving_nodes(shot_.scene, shot_.animations);
  const std::vector<glm::mat4> world = world_matrices(shot_.scene, shot_.animations, 0);
  still_ = std::make_unique<Intersector>(device_, place(shot_, moves_, false, world));
  const Intersector moving(device_, place(shot_, moves_, true, world));
  if (shot_.ambient_reach > 0) measure_openness(moving);
}

ShotRenderer::~ShotRenderer() = default;

void ShotRenderer::measure_openness(const Intersector& moving) {
  Box box;
  box.add(still_->meshes());
  const World world{still_.get(), &moving, &shot_.scene.textures, 1e-5f * box.diagonal()};
  std::vector<std::vector<float>> still;
  for (const PlacedMesh& mesh : still_->meshes()) still.push_back(openness(world, mesh, shot_.ambient_reach));
  for (const PlacedMesh& mesh : moving.meshes()) openness_.push_back(openness(world, mesh, shot_.ambient_reach));
  for (std::size_t i = 0; i < still.size(); ++i) still_->meshes()[i].openness = std::move(still[i]);
}

FrameCamera ShotRenderer::camera(int frame, const std::vector<glm::mat4>& world) const {
  const int node = camera_node(shot_, frame);
  if (node >= 0) return {world[static_cast<std::size_t>(node)], lens(frame).lens, raster_};
  Box box;
  box.add(still_->meshes());
  const ThinLens frame_lens = lens(frame).lens;
  return {outside(box, 2 * std::atan(lens(frame).sensor_height_mm / 2 / frame_lens.focal_length_mm)), frame_lens,
          raster_};
}

std::unique_ptr<ShotRenderer::Stage> ShotRenderer::stage(int frame) const {
  const std::vector<glm::mat4> world = world_matrices(shot_.scene, shot_.animations, frame_time(shot_, frame));
  auto moving = std::make_unique<Intersector>(device_, place(shot_, moves_, true, world));
  for (std::size_t i = 0; i < openness_.size(); ++i) moving->meshes()[i].openness = openness_[i];
  auto result = std::make_unique<Stage>(camera(frame, world), std::move(moving));
  Box box;
  box.add(still_->meshes());
  if (box.empty()) box.add(result->moving->meshes());
  result->world = {still_.get(), result->moving.get(), &shot_.scene.textures, 1e-5f * box.diagonal()};
  result->lighting = {place_lights(shot_, frame, world), shot_.sky, shot_.ambient_top, shot_.ambient_bottom};
  result->scale = static_cast<float>(std::exp2(shot_.exposure));
  return result;
}

void ShotRenderer::render(int frame, int samples, Frame& out) const {
  const auto now = stage(frame);
  const Window window{0, 0, raster_.width, raster_.height};
  out.colour.reset(window, SampleType::half);
  out.depth.reset(window, sky_depth);
  out.has_alpha = false;
  const SamplePattern pattern(samples);
  for_pixels(raster_, [&](int x, int y) {
    glm::vec3 colour = now->pixel(x, y, pattern, pixel_seed(x, y), false);
    if (shot_.noise > 0) colour *= noise_factor(shot_.noise, x, y, frame);
    store(out.colour, x, y, colour);
    Surface surface;
    if (now->world.nearest(now->camera.ray(glm::vec2(x, y) + 0.5f, {0, 0}), 0, surface))
      out.depth.at(x, y) = std::min(surface.depth, sky_depth);
  });
}

void ShotRenderer::truth(int frame, int samples, ColourImage& out) const {
  const auto now = stage(frame);
  out.reset({0, 0, raster_.width, raster_.height}, SampleType::float32);
  const SamplePattern pattern(samples);
  for_pixels(raster_, [&](int x, int y) { store(out, x, y, now->pixel(x, y, pattern, pixel_seed(x, y), true)); });
}

void ShotRenderer::truth_of_views(int frame, int views, ColourImage& out) const {
  const auto now = stage(frame);
  out.reset({0, 0, raster_.width, raster_.height}, SampleType::float32);
  const SamplePattern pattern(views);
  for_pixels(raster_, [&](int x, int y) { store(out, x, y, now->pixel(x, y, pattern, 0, true)); });
}

void ShotRenderer::deep(int frame, DeepPixels& out) const {
  const auto now = stage(frame);
  out = {raster_.width, raster_.height, {}};
  out.pixels.resize(static_cast<std::size_t>(raster_.width) * static_cast<std::size_t>(raster_.height));
  for_pixels(raster_, [&](int x, int y) {
    auto& samples =
        out.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.width) + static_cast<std::size_t>(x)];
    const Ray ray = now->camera.ray(glm::vec2(x, y) + 0.5f, {0, 0});
    float from = 0;
    Surface surface;
    while (samples.size() < deepest && now->world.nearest(ray, from, surface) && surface.depth < sky_depth) {
      samples.push_back({surface.depth, now->scale * shade(now->world, now->lighting, surface, ray.direction)});
      from = surface.depth * (1 + same_surface);
    }
    samples.push_back({sky_depth, now->scale * now->lighting.sky.radiance(ray.direction)});
  });
}

}  // namespace pullfocus::sequences
