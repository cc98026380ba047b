#include "scatter/disc.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pullfocus {

namespace {

constexpr int kSub = 16;  // subsamples per pixel and axis, at the centres of a 16 x 16 grid
constexpr double kMixBelow = 2;
constexpr double kGoodMoment = 0.006;  // of both axes together

constexpr double kTuneBelow = 64;

int levels_for(double diameter) {
  if (diameter < 12) return 16;
  if (diameter < 16) return 8;
  if (diameter < 20) return 3;
  return diameter < 40 ? 2 : 1;
}

struct Disc {
  int rx, ry;
  std::vector<std::int32_t> shares;
};

// Number of subsamples with centre at (i + 1/2) / kSub, i >= 0, that lie within `extent` of the pixel grid's
// axis.
int subsamples_within(double extent) {
  int n = static_cast<int>(extent * kSub + 0.5);
  while (n > 0 && (n - 0.5) / kSub > extent) --n;
  while ((n + 0.5) / kSub <= extent) ++n;
  return n;
}

Disc sample_disc(double diameter, double aspect, int levels) {
  const double r = diameter / 2, r_vertical = r * aspect;
  Disc disc{static_cast<int>(std::ceil(r + 0.5)), static_cast<int>(std::ceil(r_vertical + 0.5)), {}};
  const int columns = 2 * disc.rx + 1;
  disc.shares.assign(static_cast<std::size_t>(columns * (2 * disc.ry + 1)), 0);
  std::vector<int> covered(static_cast<std::size_t>(disc.rx) + 1);
  for (int dy = 0; dy <= disc.ry; ++dy) {
    std::fill(covered.begin(), covered.end(), 0);
    for (int s = 0; s < kSub; ++s) {
      const double y = (dy - 0.5 + (s + 0.5) / kSub) / aspect;
      if (y * y > r * r) continue;
      // Columns to the right of the centre line, counted from it; pixel 0 straddles the line and gets both
      // halves.
      const int n = subsamples_within(std::sqrt(r * r - y * y));
      covered[0] += 2 * std::min(n, kSub / 2);
      for (int dx = 1; dx <= disc.rx && n > kSub * dx - kSub / 2; ++dx) {
        covered[static_cast<std::size_t>(dx)] += std::min(n - (kSub * dx - kSub / 2), kSub);
      }
    }
    for (int dx = -disc.rx; dx <= disc.rx; ++dx) {
      const int share = (covered[static_cast<std::size_t>(std::abs(dx))] * levels + kSub * kSub / 2) / (kSub * kSub);
      for (const int row : {disc.ry - dy, disc.ry + dy}) {
        disc.shares[static_cast<std::size_t>(row * columns + dx + disc.rx)] = share;
      }
    }
  }
  return disc;
}

// Relative deviation of the second moments from those of the true disc over square pixels; huge if empty.
double moment_error(const Disc& disc, double diameter, double aspect) {
  double sum = 0, xx = 0, yy = 0;
  std::size_t i = 0;
  for (int dy = -disc.ry; dy <= disc.ry; ++dy) {
    for (int dx = -disc.rx; dx <= disc.rx; ++dx) {
      const double share = disc.shares[i++];
      sum += share;
      xx += share * dx * dx;
      yy += share * dy * dy;
    }
  }
  if (sum == 0) return 1e9;
  const double vertical = diameter * aspect;
  return std::fabs(xx / sum / (diameter * diameter / 16 + 1. / 12) - 1) +
         std::fabs(yy / sum / (vertical * vertical / 16 + 1. / 12) - 1);
}

Disc best_disc(double diameter, double aspect) {
  const int levels = levels_for(diameter);
  Disc best = sample_disc(diameter, aspect, levels);
  if (diameter >= kTuneBelow) return best;
  double least = moment_error(best, diameter, aspect);
  // From the nominal diameter outwards, to the first adjustment that is good enough.
  for (int step = 1; step <= 60 && least > kGoodMoment; ++step) {
    const double adjust = (step % 2 ? 1 : -1) * ((step + 1) / 2) * 0.01;
    Disc disc = sample_disc(diameter + adjust, aspect, levels);
    const double error = moment_error(disc, diameter, aspect);
    if (error >= least) continue;
    least = error;
    best = std::move(disc);
  }
  return best;
}

}  // namespace

Kernel disc_kernel(double diameter_px, double pixel_aspect) {
  if (diameter_px <= 0) return kernel_from_shares(0, 0, {1});
  Disc disc = best_disc(std::max(diameter_px, kMixBelow), pixel_aspect);
  const std::size_t centre = disc.shares.size() / 2;
  std::int64_t sum = 0;
  for (const std::int32_t share : disc.shares) sum += share;
  if (sum == 0) return kernel_from_shares(0, 0, {1});
  if (diameter_px < kMixBelow) {
    // In 1024ths, exact for multiples of 1/16 px: share (D / 2)^2 of the disc, the rest of the identity.
    const auto mixed = static_cast<std::int32_t>(diameter_px * diameter_px / 4 * 1024);
    for (std::int32_t& share : disc.shares) share *= mixed;
    disc.shares[centre] += static_cast<std::int32_t>(sum) * (1024 - mixed);
  }
  return kernel_from_shares(disc.rx, disc.ry, disc.shares);
}

}  // namespace pullfocus
