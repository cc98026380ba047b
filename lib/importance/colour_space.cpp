#include "importance/colour_space.h"

#include <cmath>
#include <string>

#include "image/error.h"

namespace pullfocus {

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Vector xyz_of(const std::array<double, 2>& xy) { return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]}; }

double determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
}

// Scales the primaries so that together they make the white of Y = 1.
Matrix rgb_to_xyz(const Chromaticities& c) {
  const Vector red = xyz_of(c.red), green = xyz_of(c.green), blue = xyz_of(c.blue), white = xyz_of(c.white);
  const double whole = determinant(red, green, blue);
  const double r = determinant(white, green, blue) / whole, g = determinant(red, white, blue) / whole,
               b = determinant(red, green, white) / whole;
  Matrix matrix{};
  for (std::size_t i = 0; i < 3; ++i) {
    matrix[i] = {r * red[i], g * green[i], b * blue[i]};
    for (const double value : matrix[i]) {
      if (!std::isfinite(value)) {
        throw Error(ErrorCode::content, "the chromaticities attribute names primaries that span no colour space");
      }
    }
  }
  return matrix;
}

double u_prime(const Vector& xyz) { return 4 * xyz[0] / (xyz[0] + 15 * xyz[1] + 3 * xyz[2]); }
double v_prime(const Vector& xyz) { return 9 * xyz[1] / (xyz[0] + 15 * xyz[1] + 3 * xyz[2]); }

}  // namespace

std::string_view name(ColourDistance distance) noexcept { return distance == ColourDistance::rgb ? "rgb" : "cieluv"; }

ColourDistance parse_colour_distance(std::string_view text) {
  for (const ColourDistance distance : {ColourDistance::rgb, ColourDistance::cieluv}) {
    if (text == name(distance)) return distance;
  }
  throw Error(ErrorCode::usage, "--colour-distance '" + std::string(text) + "' is not known: use rgb or cieluv");
}

ColourMetric::ColourMetric(ColourDistance distance, const Chromaticities& chromaticities) : distance_(distance) {
  if (distance == ColourDistance::rgb) return;
  to_xyz_ = rgb_to_xyz(chromaticities);
  const Vector white = xyz_of(chromaticities.white);
  white_u_ = u_prime(white);
  white_v_ = v_prime(white);
}

// CIE 15: L* = 116 Y^(1/3) - 16 above Y = (6/29)^3, (29/3)^3 Y below; u* = 13 L* (u' - u'_white), v* alike.
std::array<double, 3> ColourMetric::cieluv(const std::array<double, 3>& rgb) const noexcept {
  Vector xyz{};
  for (std::size_t i = 0; i < 3; ++i) {
    xyz[i] = to_xyz_[i][0] * rgb[0] + to_xyz_[i][1] * rgb[1] + to_xyz_[i][2] * rgb[2];
  }
  constexpr double knee = (6. / 29) * (6. / 29) * (6. / 29), slope = (29. / 3) * (29. / 3) * (29. / 3);
  const double lightness = (xyz[1] > knee ? 116 * std::cbrt(xyz[1]) - 16 : slope * xyz[1]) / 100;
  // Beyond what a set of real lights can show the quotients grow without measure.
  if (!(xyz[0] + 15 * xyz[1] + 3 * xyz[2] > 0) || xyz[1] <= 0) return {lightness, 0, 0};
  return {lightness, 13 * lightness * (u_prime(xyz) - white_u_), 13 * lightness * (v_prime(xyz) - white_v_)};
}

}  // namespace pullfocus
