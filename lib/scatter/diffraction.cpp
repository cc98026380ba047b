#include "scatter/diffraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scatter/density.h"

namespace pullfocus {

namespace {

// Where levels begin. The ripples of the middle, 0.95 to 1.10 flat discs, stay within one: thin rings cost edges.
constexpr std::int32_t kFlat = Density::kPeak / 2;
constexpr std::int32_t kBorders[] = {kFlat * 8 / 100,  kFlat * 24 / 100, kFlat * 40 / 100,  kFlat * 57 / 100,
                                     kFlat * 74 / 100, kFlat * 92 / 100, kFlat * 112 / 100, kFlat * 121 / 100};
constexpr double kDefocus = 64, kCentralWavelength = 550, kShortest = 400, kLongest = 700;  // nm
constexpr int kWavelengths = 16;
constexpr double kNominalDiameter = 12;  // px
constexpr int kRadii = 640;              // of the exact profile, from 0 to beyond kOuter

// J(n, x) for n = 0, 1, ... until negligible, by downward recurrence (Miller), x > 0.
std::vector<double> bessel(double x) {
  const int from = static_cast<int>(x) + 60;
  std::vector<double> j(static_cast<std::size_t>(from) + 2);
  j[static_cast<std::size_t>(from)] = 1e-300;
  for (auto n = static_cast<std::size_t>(from); n > 0; --n) {
    j[n - 1] = 2. * static_cast<double>(n) / x * j[n] - j[n + 1];
    if (std::fabs(j[n - 1]) < 1e200) continue;
    for (double& value : j) value *= 1e-200;
  }
  double sum = j[0];
  for (std::size_t n = 2; n < j.size(); n += 2) sum += 2 * j[n];
  for (double& value : j) value /= sum;
  return j;
}

// Sum over s of (-1)^s ratio^(n + 2s) J(n + 2s), ratio <= 1.
double lommel(std::size_t n, double ratio, const std::vector<double>& j) {
  double sum = 0, factor = std::pow(ratio, static_cast<double>(n));
  for (; n < j.size(); n += 2) {
    sum += factor * j[n];
    factor *= -ratio * ratio;
  }
  return sum;
}

double monochromatic(double u, double rho) {
  if (rho < 1e-9) return 4 * std::pow(std::sin(u / 4), 2);
  const double v = u * rho;
  const std::vector<double> j = bessel(v);
  if (rho >= 1) {
    const double u1 = lommel(1, 1 / rho, j), u2 = lommel(2, 1 / rho, j);
    return u1 * u1 + u2 * u2;
  }
  const double v0 = lommel(0, rho, j), v1 = lommel(1, rho, j), phase = (u + v * rho) / 2;
  return 1 + v0 * v0 + v1 * v1 - 2 * v0 * std::cos(phase) - 2 * v1 * std::sin(phase);
}

}  // namespace

double DiffractionProfile::exact(double rho) {
  double sum = 0;
  for (int i = 0; i < kWavelengths; ++i) {
    const double wavelength = kShortest + (kLongest - kShortest) * (i + 0.5) / kWavelengths;
    sum += monochromatic(kDefocus * kCentralWavelength / wavelength, rho);
  }
  return sum / kWavelengths;
}

DiffractionProfile::DiffractionProfile() {
  constexpr double pixel = 2 / kNominalDiameter, step = (kOuter + pixel) / kRadii;
  std::array<double, kRadii + 2> by_radius{};
  for (int i = 0; i < kRadii + 2; ++i) by_radius[static_cast<std::size_t>(i)] = exact(i * step);
  const auto sharp = [&](double rho) {
    const double cell = std::min(rho / step, static_cast<double>(kRadii));
    const auto i = static_cast<std::size_t>(cell);
    return std::lerp(by_radius[i], by_radius[i + 1], cell - std::floor(cell));
  };
  // Averaged over a disc of the area of a pixel: rings of equal area, points of equal distance on them.
  constexpr int rings = 6, points = 12;
  for (int cell = 0; cell < kCells; ++cell) {
    const double rho = kOuter * std::sqrt((cell + 0.5) / kCells);
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const double r = pixel / std::sqrt(std::numbers::pi) * std::sqrt((ring + 0.5) / rings);
      for (int point = 0; point < points; ++point) {
        const double angle = 2 * std::numbers::pi * (point + 0.5 * (ring % 2)) / points;
        sum += sharp(std::hypot(rho + r * std::cos(angle), r * std::sin(angle)));
      }
    }
    values_.push_back(sum / (rings * points));
  }
}

Kernel diffraction_kernel(double diameter_px, double pixel_aspect, const DiffractionProfile& profile) {
  const double r = std::max(diameter_px, kMixBelow) / 2, r_vertical = r * pixel_aspect;
  const double smaller = std::min(r, r_vertical);
  const int sub = smaller < 4 ? 16 : smaller < 16 ? 8 : smaller < 64 ? 4 : 2;  // points a pixel and axis
  Density density(r * DiffractionProfile::kOuter, r_vertical * DiffractionProfile::kOuter);
  const auto squares = [sub](int pixel, double radius) {
    std::array<double, 16> s{};
    for (int i = 0; i < sub; ++i)
      s[static_cast<std::size_t>(i)] = std::pow((pixel - 0.5 + (i + 0.5) / sub) / radius, 2);
    return s;
  };
  for (int dy = 0; dy <= density.ry(); ++dy) {
    const auto ys = squares(dy, r_vertical);
    for (int dx = 0; dx <= density.rx(); ++dx) {
      const auto xs = squares(dx, r);
      double sum = 0;
      for (int i = 0; i < sub; ++i) {
        for (int k = 0; k < sub; ++k)
          sum += profile.at(xs[static_cast<std::size_t>(i)] + ys[static_cast<std::size_t>(k)]);
      }
      density.set_mirrored(dx, dy, static_cast<std::int32_t>(std::lrint(sum / (sub * sub) * kFlat)));
    }
  }
  return kernel_from_density(density, {std::begin(kBorders), std::end(kBorders)}, diameter_px);
}

}  // namespace pullfocus
