// How noticeable a pending change is (Fearing 1996, section 4.3, eq. 4).
#pragma once

#include <cstdint>

namespace pullfocus {

struct ImportanceOptions {
  double w_coc = 0.5;  // weight of the change of CoC diameter, per pixel of diameter; >= 0
  double w_rgb = 0.5;  // weight of the Euclidean change of linear RGB; >= 0
};

// Changes that are not worth an update: against the committed state, so that slow drifts are not lost. A pixel is
// exempt as long as all of its changes are within their thresholds; beyond any of them all of it is taken over. 0:
// nothing is exempt, and the result is exact.
struct ChangeThresholds {
  double coc_px = 0;  // of the CoC diameter in the table, pixels; >= 0
  double rgb = 0;     // of colour, Euclidean in linear RGB, and of alpha; >= 0

  bool any() const noexcept { return coc_px > 0 || rgb > 0; }
};

// Throws Error(usage) naming --coc-threshold or --rgb-threshold.
void validate(const ChangeThresholds& thresholds);

// Buckets are logarithmic in h, eight an octave, so that HDR changes and faint ones spread alike: bucket 1
// holds h < 2^-12, the last one h >= 2^12. Bucket 0 holds unchanged pixels only and is never returned.
inline constexpr int kBuckets = 24 * 8 + 3;

int bucket_of(double h) noexcept;

// Throws Error(usage) naming --w-coc or --w-rgb.
void validate(const ImportanceOptions& options);

// A bijection of 32-bit numbers that scatters neighbours: orders pixels of one bucket without favouring a
// region.
inline std::uint32_t scrambled(std::uint32_t position) noexcept {
  position ^= position >> 16;
  position *= 0x7feb352du;
  position ^= position >> 15;
  position *= 0x846ca68bu;
  position ^= position >> 16;
  return position;
}

}  // namespace pullfocus
