#include "importance/importance.h"

#include <bit>
#include <cmath>

#include "image/error.h"

namespace pullfocus {

int bucket_of(double h) noexcept {
  if (!(h >= 0x1p-12)) return 1;
  if (h >= 0x1p12) return kBuckets - 1;
  // Exponent and three mantissa bits of a double, counted from those of 2^-12.
  constexpr std::uint64_t first = std::bit_cast<std::uint64_t>(0x1p-12) >> 49;
  return 2 + static_cast<int>((std::bit_cast<std::uint64_t>(h) >> 49) - first);
}

namespace {

void require_not_negative(double value, const char* option) {
  if (value >= 0 && std::isfinite(value)) return;
  throw Error(ErrorCode::usage, std::string(option) + " must be a finite number of at least 0");
}

}  // namespace

void validate(const ImportanceOptions& options) {
  require_not_negative(options.w_coc, "--w-coc");
  require_not_negative(options.w_rgb, "--w-rgb");
}

void validate(const ChangeThresholds& thresholds) {
  require_not_negative(thresholds.coc_px, "--coc-threshold");
  require_not_negative(thresholds.rgb, "--rgb-threshold");
}

}  // namespace pullfocus
