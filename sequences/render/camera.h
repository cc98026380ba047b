// Rays of the pinhole camera and of the thin lens around its pinhole.
//
// In camera space (right, up, backwards) the pinhole's ray through film point q has direction d = (q.x, q.y, -1) per
// unit of planar depth. A thin lens focused at P bends the ray through lens point l so that it meets the pinhole's ray
// at depth P: origin l, direction d - l/P (P may be infinite). At depth U it is off by l (1 - U/P), which on an image
// plane at distance v is v l (1/U - 1/P): for |l| up to F/2n, the circle of confusion of camera/thin_lens.h. The ray
// parameter is the planar depth.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "camera/thin_lens.h"

namespace pullfocus::sequences {

struct Ray {
  glm::vec3 origin{0}, direction{0};  // world space; direction is one unit of planar depth long
};

class FrameCamera {
 public:
  // `world`: the camera node's matrix, of which only rotation and translation count. Pixels are square.
  // Throws Error(usage) as validate(ThinLens) does.
  FrameCamera(const glm::mat4& world, const ThinLens& lens, const Raster& raster);

  // `pixel` in pixels from the top left corner of the display window; `lens_point` on the unit disc, {0,0} for the
  // pinhole.
  Ray ray(glm::vec2 pixel, glm::vec2 lens_point) const noexcept;

  FrameCamera pinhole() const noexcept;                 // the same without a lens: whatever the focus
  bool operator==(const FrameCamera&) const = default;  // the same rays

 private:
  glm::vec3 position_{0}, right_{1, 0, 0}, up_{0, 1, 0}, forward_{0, 0, -1};
  float film_per_pixel_ = 0;  // size of a pixel at depth 1
  glm::vec2 centre_{0};       // pixels
  float lens_radius_ = 0;     // scene units
  float inverse_focus_ = 0;   // 1 / scene units
};

// Distance between lens and image plane, in millimetres: the focal length, or with LensModel::paper F P / (P - F).
double image_distance_mm(const ThinLens& lens);

}  // namespace pullfocus::sequences
