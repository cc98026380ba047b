#include "render/camera.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace pullfocus::sequences {
namespace {

glm::vec3 axis(const glm::mat4& world, int column, const glm::vec3& fallback) {
  const glm::vec3 v(world[column]);
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : fallback;
}

}  // namespace

double image_distance_mm(const ThinLens& lens) {
  const double focus_mm = lens.focus_distance * 1000 * lens.metres_per_unit;
  if (lens.model == LensModel::render || std::isinf(focus_mm)) return lens.focal_length_mm;
  return lens.focal_length_mm * (focus_mm / (focus_mm - lens.focal_length_mm));
}

FrameCamera::FrameCamera(const glm::mat4& world, const ThinLens& lens, const Raster& raster) {
  validate(lens);
  position_ = glm::vec3(world[3]);
  right_ = axis(world, 0, right_);
  up_ = axis(world, 1, up_);
  forward_ = -axis(world, 2, -forward_);
  const double pixel_mm = 1 / pixels_per_mm(lens, raster);
  film_per_pixel_ = static_cast<float>(pixel_mm / image_distance_mm(lens));
  centre_ = 0.5f * glm::vec2(raster.width, raster.height);
  lens_radius_ = static_cast<float>(lens.focal_length_mm / lens.f_number / 2 / (1000 * lens.metres_per_unit));
  inverse_focus_ = static_cast<float>(1 / lens.focus_distance);
}

FrameCamera FrameCamera::pinhole() const noexcept {
  FrameCamera camera = *this;
  camera.lens_radius_ = camera.inverse_focus_ = 0;
  return camera;
}

Ray FrameCamera::ray(glm::vec2 pixel, glm::vec2 lens_point) const noexcept {
  const glm::vec2 lens = lens_radius_ * lens_point;
  const glm::vec2 film((pixel.x - centre_.x) * film_per_pixel_, (centre_.y - pixel.y) * film_per_pixel_);
  const glm::vec2 slope = film - inverse_focus_ * lens;
  return {position_ + lens.x * right_ + lens.y * up_, forward_ + slope.x * right_ + slope.y * up_};
}

}  // namespace pullfocus::sequences
