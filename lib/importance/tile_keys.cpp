#include "importance/tile_keys.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "importance/tile_keys.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void Within(const TileKeys& keys, std::uint16_t least, std::uint16_t range, TileMask& mask) {
  const hn::CappedTag<std::uint16_t, kTileWidth> d;
  const auto from = hn::Set(d, least), most = hn::Set(d, range);
  for (int i = 0; i < kTileHeight; ++i) {
    if (mask.rows[i] == 0) continue;
    std::uint64_t row = 0;
    for (int p = 0; p < kTileWidth; p += static_cast<int>(hn::Lanes(d))) {
      const auto above = hn::Sub(hn::Load(d, keys.of[i] + p), from);  // keys below `from` wrap around
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::Eq(hn::Min(above, most), above), bits);
      std::uint64_t word;
      std::memcpy(&word, bits, sizeof word);
      row |= word << p;
    }
    mask.rows[i] &= row;
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(Within);

TileMask within(const TileKeys& keys, const TileMask& mask, unsigned least, unsigned most) noexcept {
  if (least > most) return {};
  TileMask pixels = mask;
  HWY_DYNAMIC_DISPATCH(Within)
  (keys, static_cast<std::uint16_t>(least), static_cast<std::uint16_t>(most - least), pixels);
  return pixels;
}

}  // namespace pullfocus
#endif
