#include "metrics/opponent.h"

#include <cmath>

namespace pullfocus {

namespace {

// Rows of linear Rec. 709 RGB -> XYZ, each divided by its sum, so that white becomes (1, 1, 1). The fractions are the
// exact ones of the primaries and D65 (x = 0.3127, y = 0.3290).
constexpr double kX = 10135552. + 8788810. + 4435075., kY = 2613072. + 8788810. + 887015.,
                 kZ = 1425312. + 8788810. + 70074185.;
constexpr double kToRelative[3][3] = {{10135552. / kX, 8788810. / kX, 4435075. / kX},
                                      {2613072. / kY, 8788810. / kY, 887015. / kY},
                                      {1425312. / kZ, 8788810. / kZ, 70074185. / kZ}};

struct Matrix {
  double m[3][3];
};

constexpr Matrix inverse(const double (&a)[3][3]) {
  const auto cofactor = [&](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1];
  };
  const double determinant = a[0][0] * cofactor(0, 0) + a[0][1] * cofactor(0, 1) + a[0][2] * cofactor(0, 2);
  Matrix out{};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) out.m[r][c] = cofactor(c, r) / determinant;
  }
  return out;
}
constexpr Matrix kFromRelative = inverse(kToRelative);

Triple times(const double (&m)[3][3], const Triple& v) noexcept {
  return {m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2], m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
          m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2]};
}

double lab_root(double t) noexcept {
  constexpr double delta = 6. / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4. / 29;
}

}  // namespace

Triple to_ycxcz(const Triple& rgb) noexcept {
  const Triple t = times(kToRelative, rgb);
  return {116 * t[1] - 16, 500 * (t[0] - t[1]), 200 * (t[1] - t[2])};
}

Triple from_ycxcz(const Triple& v) noexcept {
  const double y = (v[0] + 16) / 116;
  return times(kFromRelative.m, {y + v[1] / 500, y, y - v[2] / 200});
}

Triple to_hunt_lab(const Triple& rgb) noexcept {
  const Triple t = times(kToRelative, rgb);
  const double x = lab_root(t[0]), y = lab_root(t[1]), z = lab_root(t[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double hyab(const Triple& a, const Triple& b) noexcept {
  return std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

}  // namespace pullfocus
