#include "importance/importance.h"

#include <bit>
#include <cmath>
#include <string>

#include "image/error.h"

namespace pullfocus {

namespace {

constexpr std::string_view kOrders[] = {"gain", "fearing", "random"};

// kMostBuckets: an octave in 64 parts, from 1 on.
int finest_bucket_of(double h) noexcept {
  if (!(h >= 0x1p-12)) return 1;
  if (h >= 0x1p12) return kMostBuckets;
  // Exponent and six mantissa bits of a double, counted from those of 2^-12.
  constexpr std::uint64_t first = std::bit_cast<std::uint64_t>(0x1p-12) >> 46;
  return 2 + static_cast<int>((std::bit_cast<std::uint64_t>(h) >> 46) - first);
}

void require_not_negative(double value, const char* option) {
  if (value >= 0 && std::isfinite(value)) return;
  throw Error(ErrorCode::usage, std::string(option) + " must be a finite number of at least 0");
}

}  // namespace

std::string_view name(Order order) noexcept { return kOrders[static_cast<int>(order)]; }

Order parse_order(std::string_view text) {
  for (const Order order : {Order::gain, Order::fearing, Order::random}) {
    if (text == name(order)) return order;
  }
  throw Error(ErrorCode::usage, "--order '" + std::string(text) + "' is not known: use gain, fearing or random");
}

int bucket_of(double h, int buckets) noexcept {
  const int finest = finest_bucket_of(h);
  if (buckets < 3) return 1 + (finest - 1) * buckets / kMostBuckets;
  if (finest == 1) return 1;
  if (finest == kMostBuckets) return buckets;
  return 2 + (finest - 2) * (buckets - 2) / (kMostBuckets - 2);
}

void validate(const ImportanceOptions& options) {
  require_not_negative(options.w_coc, "--w-coc");
  require_not_negative(options.w_rgb, "--w-rgb");
  if (options.buckets < 1 || options.buckets > kMostBuckets) {
    throw Error(ErrorCode::usage, "--buckets must lie between 1 and " + std::to_string(kMostBuckets));
  }
}

void validate(const ChangeThresholds& thresholds) {
  require_not_negative(thresholds.coc_px, "--coc-threshold");
  require_not_negative(thresholds.rgb, "--rgb-threshold");
  require_not_negative(thresholds.channel, "--error-bound");
}

}  // namespace pullfocus
