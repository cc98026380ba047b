// How noticeable a pending change is, and from when on it counts.
#pragma once

#include <cstdint>
#include <string_view>

#include "importance/colour_space.h"

namespace pullfocus {

// What comes first under a partial budget.
enum class Order {
  gain,     // the estimated visible error that updating a pixel removes; per unit of work when time is what is short
  fearing,  // h = w_coc |dC| + w_rgb |dI|, in buckets (Fearing 1996, section 4.3, eq. 4)
  random    // for comparison
};

std::string_view name(Order order) noexcept;  // as --order spells it
Order parse_order(std::string_view text);     // throws Error(usage) naming --order

// Buckets of Order::fearing are logarithmic in h, so that HDR changes and faint ones spread alike. Bucket 0 holds
// unchanged pixels only.
inline constexpr int kMostBuckets = 24 * 64 + 2;

struct ImportanceOptions {
  Order order = Order::gain;
  double w_coc = 0.5;  // Order::fearing: weight of the change of CoC diameter, per pixel of diameter; >= 0
  double w_rgb = 0.5;  // Order::fearing: weight of the change of colour (see ColourMetric); >= 0
  int buckets = 194;   // Order::fearing: 1..kMostBuckets; 194 are eight an octave from 2^-12 to 2^12
  ColourMetric metric;
};

// Throws Error(usage) naming --w-coc, --w-rgb or --buckets.
void validate(const ImportanceOptions& options);

// Bucket 1..buckets of h; of the finest buckets the first holds h < 2^-12, the last h >= 2^12. NaN counts as 0.
int bucket_of(double h, int buckets) noexcept;

// Changes that are not worth an update: against the committed state, so that slow drifts are not lost. A pixel is
// exempt as long as all of its changes are within their thresholds; beyond any of them all of it is taken over. 0:
// nothing is exempt, and the result is exact.
struct ChangeThresholds {
  double coc_px = 0;   // of the CoC diameter in the table, pixels; >= 0
  double rgb = 0;      // of colour, Euclidean in linear RGB, and of alpha; >= 0
  double channel = 0;  // of any single channel of linear RGBA: bounds the error, see FilterOptions::error_bound; >= 0

  bool any() const noexcept { return coc_px > 0 || rgb > 0 || channel > 0; }
};

// Throws Error(usage) naming --coc-threshold, --rgb-threshold or --error-bound.
void validate(const ChangeThresholds& thresholds);

// A bijection of 32-bit numbers that scatters neighbours: orders pixels of equal importance without favouring a
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
