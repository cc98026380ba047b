#include "render/renderer.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/openness.h"
#include "render/placing.h"
#include "render/pose.h"
#include "render/sampling.h"

namespace pullfocus::sequences {
namespace {

constexpr float largest_half = 65504;
constexpr int tile = 16;               // pixels a side of a task
constexpr float same_surface = 1e-5f;  // hits nearer together than this share of their depth are one
constexpr std::size_t deepest = 1000;  // surfaces along a ray

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

  // Colours that at most packet_size rays bring.
  void colours(std::span<const Ray> rays, std::span<glm::vec3> out, Touch& touch) const {
    std::array<Surface, packet_size> surfaces;
    const auto met = std::span(surfaces).first(rays.size());
    world.nearest(rays, 0, met, touch);
    shade(world, lighting, rays, met, out, touch);
  }

  // Mean colour of a pixel; on the lens or, if not `through_lens`, at its middle.
  glm::vec3 pixel(int x, int y, const SamplePattern& pattern, std::uint32_t seed, bool through_lens,
                  Touch& touch) const {
    glm::dvec3 sum(0);
    const glm::vec2 corner(x, y);
    std::array<Ray, packet_size> rays;
    std::array<glm::vec3, packet_size> colour;
    for (std::size_t first = 0; first < pattern.size(); first += packet_size) {
      const std::size_t count = std::min(packet_size, pattern.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        const glm::vec2 lens = through_lens ? concentric_disc(pattern.lens(first + i, seed)) : glm::vec2(0);
        rays[i] = camera.ray(corner + pattern.pixel(first + i, seed), lens);
      }
      colours(std::span(rays).first(count), colour, touch);
      for (std::size_t i = 0; i < count; ++i) sum += scale * colour[i];
    }
    return sum / static_cast<double>(pattern.size());
  }

  // Planar depth of what the pixel's middle shows.
  float depth(int x, int y, Touch& touch) const {
    const Ray ray = camera.ray(glm::vec2(x, y) + 0.5f, {0, 0});
    Surface surface;
    world.nearest({&ray, 1}, 0, {&surface, 1}, touch);
    return std::min(surface.depth, sky_depth);
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
  reach_ = reach_of_moving(shot_, moves_);
}

ShotRenderer::~ShotRenderer() = default;

void ShotRenderer::measure_openness(const Intersector& moving) {
  const World world{still_.get(), &moving, &shot_.scene.textures, 1e-5f * box_of(still_->meshes()).diagonal()};
  std::vector<std::vector<float>> still;
  for (const PlacedMesh& mesh : still_->meshes()) still.push_back(openness(world, mesh, shot_.ambient_reach));
  for (const PlacedMesh& mesh : moving.meshes()) openness_.push_back(openness(world, mesh, shot_.ambient_reach));
  for (std::size_t i = 0; i < still.size(); ++i) still_->meshes()[i].openness = std::move(still[i]);
}

FrameCamera ShotRenderer::camera(int frame, const std::vector<glm::mat4>& world) const {
  const int node = camera_node(shot_, frame);
  if (node >= 0) return {world[static_cast<std::size_t>(node)], lens(frame).lens, raster_};
  const ThinLens frame_lens = lens(frame).lens;
  return {
      outside(box_of(still_->meshes()), 2 * std::atan(lens(frame).sensor_height_mm / 2 / frame_lens.focal_length_mm)),
      frame_lens, raster_};
}

std::unique_ptr<ShotRenderer::Stage> ShotRenderer::stage(int frame) const {
  const std::vector<glm::mat4> world = world_matrices(shot_.scene, shot_.animations, frame_time(shot_, frame));
  auto moving = std::make_unique<Intersector>(device_, place(shot_, moves_, true, world));
  for (std::size_t i = 0; i < openness_.size(); ++i) moving->meshes()[i].openness = openness_[i];
  auto result = std::make_unique<Stage>(camera(frame, world), std::move(moving));
  Box box = box_of(still_->meshes());
  if (box.empty()) box = box_of(result->moving->meshes());
  result->world = {still_.get(), result->moving.get(), &shot_.scene.textures, 1e-5f * box.diagonal()};
  result->lighting = {place_lights(shot_, frame, world), shot_.sky, shot_.ambient_top, shot_.ambient_bottom};
  result->scale = static_cast<float>(std::exp2(shot_.exposure));
  return result;
}

template <class Draw, class Store>
void ShotRenderer::draw(int frame, const Stage& now, const StillPixels::Setting& setting, StillPixels* still,
                        const Draw& draw_pixel, const Store& store_pixel) const {
  if (still && still->setting != setting) {
    still->setting = setting;
    still->pixels.assign(static_cast<std::size_t>(raster_.width) * static_cast<std::size_t>(raster_.height), {});
  }
  std::uint32_t span = 0;  // none: nothing moves
  bool reusable = true;
  if (!now.moving->box().empty()) {
    const bool within = frame >= shot_.first_frame && frame <= shot_.last_frame;
    const auto number = static_cast<std::size_t>(within ? span_of(shot_, frame) : 0);
    reusable = within && number < reach_.spans.size() && reach_.spans[number].holds(now.moving->box());
    span = reusable ? std::uint32_t{1} << number : 0;
  }
  constexpr int most_tries = 4;
  for_pixels(raster_, [&](int x, int y) {
    StillPixels::Pixel drawn;
    StillPixels::Pixel* kept =
        still ? &still->pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.width) +
                               static_cast<std::size_t>(x)]
              : nullptr;
    if (kept && kept->known && reusable && (kept->touched & span) == 0) return store_pixel(x, y, *kept);
    const bool learn = kept && !kept->known && kept->tries < most_tries;
    Touch touch;
    if (learn) touch.reach = &reach_;
    draw_pixel(x, y, drawn, touch);
    if (learn && touch.now) ++kept->tries;
    if (learn && !touch.now) {
      *kept = drawn;
      kept->known = true;
      kept->touched = touch.spans;
    }
    store_pixel(x, y, drawn);
  });
}

void ShotRenderer::render(int frame, int samples, Frame& out, StillPixels* still) const {
  const auto now = stage(frame);
  const Window window{0, 0, raster_.width, raster_.height};
  out.colour.reset(window, SampleType::half);
  out.depth.reset(window, sky_depth);
  out.has_alpha = false;
  const SamplePattern pattern(samples);
  draw(
      frame, *now, {now->camera.pinhole(), now->lighting, samples, false}, still,
      [&](int x, int y, StillPixels::Pixel& pixel, Touch& touch) {
        pixel.colour = now->pixel(x, y, pattern, pixel_seed(x, y), false, touch);
        pixel.depth = now->depth(x, y, touch);
      },
      [&](int x, int y, const StillPixels::Pixel& pixel) {
        const float noise = shot_.noise > 0 ? noise_factor(shot_.noise, x, y, frame) : 1;
        store(out.colour, x, y, noise * pixel.colour);
        out.depth.at(x, y) = pixel.depth;
      });
}

void ShotRenderer::truth(int frame, int samples, ColourImage& out, StillPixels* still) const {
  const auto now = stage(frame);
  out.reset({0, 0, raster_.width, raster_.height}, SampleType::float32);
  const SamplePattern pattern(samples);
  draw(
      frame, *now, {now->camera, now->lighting, samples, true}, still,
      [&](int x, int y, StillPixels::Pixel& pixel, Touch& touch) {
        pixel.colour = now->pixel(x, y, pattern, pixel_seed(x, y), true, touch);
      },
      [&](int x, int y, const StillPixels::Pixel& pixel) { store(out, x, y, pixel.colour); });
}

void ShotRenderer::truth_of_views(int frame, int views, ColourImage& out) const {
  const auto now = stage(frame);
  out.reset({0, 0, raster_.width, raster_.height}, SampleType::float32);
  const SamplePattern pattern(views);
  for_pixels(raster_, [&](int x, int y) {
    Touch touch;
    store(out, x, y, now->pixel(x, y, pattern, 0, true, touch));
  });
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
    Touch touch;
    const auto found = [&] {
      now->world.nearest({&ray, 1}, from, {&surface, 1}, touch);
      return surface.material != nullptr && surface.depth < sky_depth;
    };
    while (samples.size() < deepest && found()) {
      glm::vec3 colour;
      shade(now->world, now->lighting, {&ray, 1}, {&surface, 1}, {&colour, 1}, touch);
      samples.push_back({surface.depth, now->scale * colour});
      from = surface.depth * (1 + same_surface);
    }
    samples.push_back({sky_depth, now->scale * now->lighting.sky.radiance(ray.direction)});
  });
}

}  // namespace pullfocus::sequences
