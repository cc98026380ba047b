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

void validate(const ImportanceOptions& options) {
  const auto refuse = [](const char* option) {
    throw Error(ErrorCode::usage, std::string(option) + " must be a finite number of at least 0");
  };
  if (!(options.w_coc >= 0 && std::isfinite(options.w_coc))) refuse("--w-coc");
  if (!(options.w_rgb >= 0 && std::isfinite(options.w_rgb))) refuse("--w-rgb");
}

}  // namespace pullfocus
