#include "star_lateral.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "image/error.h"
#include "star/parts.h"

namespace pullfocus::sequences {
namespace {

constexpr double film_side_mm = 16.0 / 7;  // of the shorter side; see the header
constexpr int samples_per_side = 4;

int shorter_side(const StarLateral& scene) { return std::min(scene.width, scene.height); }

Layout layout_of(const StarLateral& scene) {
  return {0.5f * static_cast<float>(scene.width) / static_cast<float>(shorter_side(scene))};
}

// Picture units of a point given in pixels from the top left corner.
glm::vec2 picture_point(const StarLateral& scene, float x, float y) {
  const float side = static_cast<float>(shorter_side(scene));
  return {(x - 0.5f * static_cast<float>(scene.width)) / side, (0.5f * static_cast<float>(scene.height) - y) / side};
}

// Wholly in the picture at either end of its way.
StarPose pose_at(const StarLateral& scene, int frame) {
  const double span = static_cast<double>(scene.last_frame) - scene.first_frame;
  const double t = span > 0 ? std::clamp((static_cast<double>(frame) - scene.first_frame) / span, 0.0, 1.0) : 0;
  const float reach = layout_of(scene).half_width - 1.15f * star_radius;
  const float share = static_cast<float>(t);
  return {{reach * (2 * share - 1), -0.03f}, 0.35f - 1.8f * share};
}

// The surface that a ray meets, with the star or without it.
Surface trace(const Layout& layout, const StarPose* star, glm::vec2 p) {
  if (const auto front = cord(p)) return *front;
  if (star)
    if (const auto colour = star_colour(*star, p)) return {*colour, star_depth_mm};
  return backdrop(layout, p);
}

void render_pixel(const StarLateral& scene, const Layout& layout, const StarPose* star, int x, int y, Frame& out) {
  glm::vec3 sum(0);
  for (int j = 0; j < samples_per_side; ++j)
    for (int i = 0; i < samples_per_side; ++i) {
      const float dx = (static_cast<float>(i) + 0.5f) / samples_per_side;
      const float dy = (static_cast<float>(j) + 0.5f) / samples_per_side;
      sum += trace(layout, star, picture_point(scene, static_cast<float>(x) + dx, static_cast<float>(y) + dy)).colour;
    }
  const glm::vec3 mean = sum / static_cast<float>(samples_per_side * samples_per_side);
  for (int channel = 0; channel < 3; ++channel) out.colour.set(x, y, channel, mean[channel]);
  out.colour.set(x, y, 3, 1.0f);
  const glm::vec2 centre = picture_point(scene, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  out.depth.at(x, y) = trace(layout, star, centre).depth_mm / 1000.0f;
}

void render_window(const StarLateral& scene, const StarPose* star, const Window& window, Frame& out) {
  const Layout layout = layout_of(scene);
  tbb::parallel_for(tbb::blocked_range<int>(window.y0, window.y1), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y != rows.end(); ++y)
      for (int x = window.x0; x < window.x1; ++x) render_pixel(scene, layout, star, x, y, out);
  });
}

}  // namespace

void validate(const StarLateral& scene) {
  if (scene.width < 1 || scene.height < 1)
    throw Error(ErrorCode::usage, "--size " + std::to_string(scene.width) + "x" + std::to_string(scene.height) +
                                      ": a picture needs at least one pixel each way");
  if (scene.last_frame < scene.first_frame)
    throw Error(ErrorCode::usage, "--frames: the last frame, " + std::to_string(scene.last_frame) +
                                      ", comes before the first, " + std::to_string(scene.first_frame));
}

ThinLens star_lens(const StarLateral& scene) {
  ThinLens lens{8.0, 3.5, 0.040};
  lens.model = LensModel::paper;
  lens.sensor_mm = film_side_mm * scene.width / shorter_side(scene);
  return lens;
}

double star_sensor_height_mm(const StarLateral& scene) { return film_side_mm * scene.height / shorter_side(scene); }

Window star_window(const StarLateral& scene, int frame) {
  const StarPose pose = pose_at(scene, frame);
  const float side = static_cast<float>(shorter_side(scene));
  const float x = 0.5f * static_cast<float>(scene.width) + pose.centre.x * side;
  const float y = 0.5f * static_cast<float>(scene.height) - pose.centre.y * side;
  const float reach = star_radius * side;
  const Window around{static_cast<int>(std::floor(x - reach)) - 1, static_cast<int>(std::floor(y - reach)) - 1,
                      static_cast<int>(std::ceil(x + reach)) + 1, static_cast<int>(std::ceil(y + reach)) + 1};
  return intersect(around, {0, 0, scene.width, scene.height});
}

StarLateralRenderer::StarLateralRenderer(const StarLateral& scene) : scene_(scene) {
  validate(scene_);
  const Window window{0, 0, scene_.width, scene_.height};
  without_star_.colour.reset(window, SampleType::half);
  without_star_.depth.reset(window, 0.0f);
  without_star_.has_alpha = false;
  render_window(scene_, nullptr, window, without_star_);
}

void StarLateralRenderer::render(int frame, Frame& out) const {
  out = without_star_;
  const StarPose pose = pose_at(scene_, frame);
  render_window(scene_, &pose, star_window(scene_, frame), out);
}

void render(const StarLateral& scene, int frame, Frame& out) { StarLateralRenderer(scene).render(frame, out); }

}  // namespace pullfocus::sequences
