#include "scatter/index_row.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/index_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t Within(const std::int16_t* index, std::int16_t first, std::int16_t last) {
  const hn::CappedTag<std::int16_t, 32> d;
  const auto low = hn::Set(d, first), high = hn::Set(d, last);
  std::uint64_t bits = 0;
  for (int i = 0; i < kTileWidth; i += static_cast<int>(hn::Lanes(d))) {
    const auto v = hn::LoadU(d, index + i);
    std::uint8_t stored[8] = {};
    hn::StoreMaskBits(d, hn::Not(hn::Or(hn::Lt(v, low), hn::Gt(v, high))), stored);
    std::uint64_t part = 0;
    std::memcpy(&part, stored, sizeof part);
    bits |= part << i;
  }
  return bits;
}

int LargestOf(const std::int16_t* index, std::uint64_t mask) {
  const hn::CappedTag<std::int32_t, 16> d;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  auto largest = hn::Zero(d);
  for (int i = 0; i < kTileWidth; i += static_cast<int>(hn::Lanes(d))) {
    const std::uint64_t part = mask >> i;
    std::uint8_t bits[8];
    std::memcpy(bits, &part, sizeof part);
    const auto v = hn::PromoteTo(d, hn::LoadU(d16, index + i));
    largest = hn::Max(largest, hn::IfThenElseZero(hn::LoadMaskBits(d, bits), hn::Abs(v)));
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(Within);
HWY_EXPORT(LargestOf);

std::uint64_t within(const std::int16_t* index, std::int16_t first, std::int16_t last) noexcept {
  return HWY_DYNAMIC_DISPATCH(Within)(index, first, last);
}

int largest_of(const std::int16_t* index, std::uint64_t mask) noexcept {
  return HWY_DYNAMIC_DISPATCH(LargestOf)(index, mask);
}

}  // namespace pullfocus
#endif
