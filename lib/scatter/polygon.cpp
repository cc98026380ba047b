#include "scatter/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scatter/density.h"

namespace pullfocus {

namespace {

constexpr int kCoverageUnit = 256;       // a sub-row of a pixel, inside along its whole width
constexpr double kStraightBelow = 1e-6;  // roundness
constexpr double kCoarseFrom = 64;       // px of diameter

int levels_for(double diameter) {
  if (diameter < 12) return 16;
  if (diameter < 16) return 8;
  if (diameter < 64) return 4;
  return diameter < 160 ? 2 : 1;
}

// To multiples of 2^-30: mirrored blades get exactly mirrored coordinates, on every machine.
double rounded(double value) { return std::ldexp(std::nearbyint(std::ldexp(value, 30)), -30); }

struct Run {
  double from, to;  // empty if to <= from
};

// One blade of the aperture of radius 1: points (x, y), y down, with nx * x + ny * y <= offset, or within `radius` of
// (nx, ny) * offset.
struct Blade {
  double nx, ny, offset, radius;
  bool straight;

  void cut(double y, Run& run) const noexcept {
    if (!straight) {
      const double v = y - ny * offset, square = radius * radius - v * v;
      const double half = square > 0 ? std::sqrt(square) : -1e9;
      run.from = std::max(run.from, nx * offset - half);
      run.to = std::min(run.to, nx * offset + half);
    } else if (nx > 0) {
      run.to = std::min(run.to, (offset - ny * y) / nx);
    } else if (nx < 0) {
      run.from = std::max(run.from, (offset - ny * y) / nx);
    } else if (ny * y > offset) {
      run.to = run.from;
    }
  }
};

std::vector<Blade> blades_of(const KernelShape& shape) {
  const int n = shape.blades;
  // A turn by one blade is no turn at all.
  double turn = shape.blade_rotation_deg * n / 360;
  turn = rounded(turn - std::floor(turn));
  if (turn >= 1) turn = 0;
  const double apothem = rounded(std::cos(std::numbers::pi / n)), half_side = rounded(std::sin(std::numbers::pi / n));
  std::vector<Blade> blades;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (turn + k + 0.5) / n;  // anticlockwise from straight up
    Blade blade{-rounded(std::sin(angle)), -rounded(std::cos(angle)), apothem, 0, true};
    if (shape.blade_roundness > kStraightBelow) {
      blade.straight = false;
      blade.radius = 1 / shape.blade_roundness;
      blade.offset = apothem - std::sqrt(std::max(0., blade.radius * blade.radius - half_side * half_side));
    }
    blades.push_back(blade);
  }
  return blades;
}

// Adds the coverage of the run to the pixels of a row, columns counted from -rx.
void cover(const Run& run, int rx, std::vector<std::int32_t>& row) {
  if (run.to <= run.from) return;
  const int first = std::max(static_cast<int>(std::floor(run.from + 0.5)), -rx);
  const int last = std::min(static_cast<int>(std::ceil(run.to - 0.5)), rx);
  for (int dx = first; dx <= last; ++dx) {
    const double inside = std::min(dx + 0.5, run.to) - std::max(dx - 0.5, run.from);
    row[static_cast<std::size_t>(dx + rx)] += static_cast<std::int32_t>(std::lrint(kCoverageUnit * inside));
  }
}

}  // namespace

Kernel polygon_kernel(double diameter_px, double pixel_aspect, const KernelShape& shape) {
  const double diameter = std::max(diameter_px, kMixBelow), r = diameter / 2, r_vertical = r * pixel_aspect;
  const std::vector<Blade> blades = blades_of(shape);
  const double smaller = diameter * std::min(pixel_aspect, 1.);
  const int sub_rows = smaller < kCoarseFrom ? 16 : 4;
  Density density(r, r_vertical);
  std::vector<std::int32_t> row(static_cast<std::size_t>(2 * density.rx() + 1));
  for (int dy = -density.ry(); dy <= density.ry(); ++dy) {
    std::fill(row.begin(), row.end(), 0);
    for (int s = 0; s < sub_rows; ++s) {
      const double y = (dy + (2 * s + 1 - sub_rows) / (2. * sub_rows)) / r_vertical;
      Run run{-2, 2};
      for (const Blade& blade : blades) blade.cut(y, run);
      cover({run.from * r, run.to * r}, density.rx(), row);
    }
    const int scale = Density::kPeak / (kCoverageUnit * sub_rows);
    for (int dx = -density.rx(); dx <= density.rx(); ++dx) {
      density.at(dx, dy) = row[static_cast<std::size_t>(dx + density.rx())] * scale;
    }
  }
  return kernel_from_density(density, level_borders(density, levels_for(smaller), Spacing::even), diameter_px);
}

}  // namespace pullfocus
