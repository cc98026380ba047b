// The disc with diffraction (Potmesil and Chakravarty 1981, after Born and Wolf, Principles of Optics, section 8.8).
//
// At the distance rho (1 = radius of the geometric circle of confusion) a circular aperture in light of wavelength L
// gives, relative to the flat disc, with u the defocus, v = u rho, and Lommel's functions U and V,
//
//     rho < 1:   1 + V0^2 + V1^2 - 2 V0 cos((u + v^2 / u) / 2) - 2 V1 sin((u + v^2 / u) / 2)
//     rho >= 1:  U1^2 + U2^2
//     Un(u, v) = sum over s of (-1)^s (u / v)^(n + 2s) J(n + 2s, v),    Vn(u, v) = Un(v^2 / u, v)
//
// It is averaged over the visible wavelengths, 400 to 700 nm in equal parts, as u goes with 1 / L.
//
// In a lens u grows with the CoC, u = pi D p / (2 L n) for a pixel pitch p and f-number n, and the flat disc is the
// limit. The kernel has one profile for all diameters: u = 64 at 550 nm, what a CoC of 12 px has at f/5.4 with pixels
// of 10 um, averaged over the area of one of that CoC's pixels (which removes the bright spot on the axis). It shows a
// bright ring at 0.75 of the radius, 1.29 times the flat disc's density, and a soft rim. Light beyond 1.25 radii is
// cut: 1 %.
//
// At most 8 levels: no pixel is off by more than 0.12 flat discs; pixels below 0.08 (beyond 1.12 radii) get nothing.
// Second moments are 0.91 to 0.97 of the disc's from 4 px on. Below 2 px the kernel is mixed with the identity
// (density.h). Cost: about 17 x diameter edges a source, 8 times the disc's.
#pragma once

#include <vector>

#include "scatter/kernel.h"

namespace pullfocus {

class DiffractionProfile {
 public:
  static constexpr double kOuter = 1.25;  // radii

  DiffractionProfile();

  // Density at a squared distance, in geometric radii; the flat disc has 1. Zero beyond kOuter.
  double at(double rho_squared) const noexcept {
    const double cell = rho_squared * (kCells / (kOuter * kOuter));
    return cell < kCells ? values_[static_cast<std::size_t>(cell)] : 0;
  }

  // The average over wavelengths alone, at one distance; slow.
  static double exact(double rho);

 private:
  static constexpr int kCells = 4096;
  std::vector<double> values_;
};

// diameter_px in [0, 500], horizontal; pixel_aspect = pixel width / height.
Kernel diffraction_kernel(double diameter_px, double pixel_aspect, const DiffractionProfile& profile);

}  // namespace pullfocus
