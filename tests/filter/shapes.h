// Kernel shapes for tests.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "scatter/kernel.h"
#include "scatter/kernel_shape.h"

namespace pullfocus::test {

inline KernelShape polygon(int blades, double rotation = 0, double roundness = 0) {
  KernelShape shape;
  shape.kind = KernelShape::Kind::polygon;
  shape.blades = blades;
  shape.blade_rotation_deg = rotation;
  shape.blade_roundness = roundness;
  return shape;
}

inline KernelShape of_kind(KernelShape::Kind kind) {
  KernelShape shape;
  shape.kind = kind;
  return shape;
}

// A picture from a function of the position, both coordinates in -1..1 over the picture, y down.
inline KernelShape picture_of(int width, int height, const std::function<double(double x, double y)>& luminance) {
  const auto picture = std::make_shared<AperturePicture>(AperturePicture{width, height, {}});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture->luminance.push_back(static_cast<float>(luminance((2 * x + 1.) / width - 1, (2 * y + 1.) / height - 1)));
    }
  }
  KernelShape shape = of_kind(KernelShape::Kind::image);
  shape.picture = picture;
  return shape;
}

// A bright bar left of a dim one above a dark corner: no symmetry at all.
inline KernelShape lopsided_picture() {
  return picture_of(30, 24, [](double x, double y) {
    return x < -0.3 ? 3 : y < 0 ? 0.7 + 0.3 * x : x > 0.5 ? 0 : 0.1;
  });
}

inline KernelShape noise_picture() {
  return picture_of(64, 64, [](double x, double y) { return std::fabs(std::sin(x * 1234.5 + y * 777.7)); });
}

inline std::vector<KernelShape> all_shapes() {
  using Kind = KernelShape::Kind;
  return {of_kind(Kind::disc), polygon(3),          polygon(5, 17, 0.3),     polygon(6),
          polygon(7, -40, 1),  polygon(16, 5, 0.6), of_kind(Kind::gaussian), of_kind(Kind::diffraction),
          lopsided_picture(),  noise_picture()};
}

// Weighted means over a kernel, in pixels of the source.
struct Moments {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

inline Moments moments_of(const Kernel& kernel) {
  Moments m;
  double sum = 0;
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    const auto row = kernel.row(dy);
    for (std::size_t e = 0; e + 1 < row.size(); ++e) {
      const auto weight = static_cast<double>(kernel.levels[kernel.level_behind(row[e])]);
      for (int dx = row[e].dx; dx < row[e + 1].dx; ++dx) {
        sum += weight;
        m.x += weight * dx;
        m.y += weight * dy;
        m.xx += weight * dx * dx;
        m.yy += weight * dy * dy;
        m.xy += weight * dx * dy;
      }
    }
  }
  for (double* value : {&m.x, &m.y, &m.xx, &m.yy, &m.xy}) *value /= sum;
  return m;
}

inline double true_moment(double diameter) { return diameter * diameter / 16 + 1. / 12; }  // of a disc over pixels

inline bool equal(const Kernel& a, const Kernel& b) {
  if (a.radius_x != b.radius_x || a.radius_y != b.radius_y) return false;
  for (int dy = -a.radius_y; dy <= a.radius_y; ++dy) {
    for (int dx = -a.radius_x; dx <= a.radius_x; ++dx) {
      if (a.weight(dx, dy) != b.weight(dx, dy)) return false;
    }
  }
  return true;
}

}  // namespace pullfocus::test
