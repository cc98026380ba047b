#include "scatter/depth_key.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/depth_key.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMost = 64;

// Positive floats order as their bits do.
template <class D>
HWY_INLINE auto PlanarKeys(D d, hn::Vec<D> depth) {
  const hn::RebindToSigned<D> di;
  constexpr auto nearest = std::bit_cast<std::int32_t>(0x1p-33f);
  const auto is_surface =
      hn::RebindMask(di, hn::And(hn::Gt(depth, hn::Zero(d)), hn::Lt(depth, hn::Set(d, planar_background_from))));
  const auto steps = hn::ShiftRight<13>(hn::Sub(hn::BitCast(di, depth), hn::Set(di, nearest)));
  return hn::IfThenElse(is_surface, hn::Max(steps, hn::Zero(di)), hn::Set(di, kBackgroundKey));
}

template <class D>
HWY_INLINE auto CocKeys(D d, hn::Vec<D> depth) {
  const hn::RebindToSigned<D> di;
  const auto is_surface =
      hn::RebindMask(di, hn::Lt(hn::Abs(depth), hn::Set(d, std::numeric_limits<float>::infinity())));
  const auto kept = hn::Min(hn::Max(depth, hn::Set(d, -511.f)), hn::Set(d, 511.f));
  const auto steps = hn::ConvertTo(di, hn::Floor(hn::Mul(kept, hn::Set(d, 64.f))));
  return hn::IfThenElse(is_surface, hn::Add(steps, hn::Set(di, 32768)), hn::Set(di, kBackgroundKey));
}

template <DepthKind kind>
HWY_INLINE void KeyVectors(const float* depth, int count, std::uint16_t* keys) {
  const hn::CappedTag<float, kMost> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < count; i += lanes) {
    const auto z = hn::LoadU(d, depth + i);
    if constexpr (kind == DepthKind::planar) {
      hn::StoreU(hn::DemoteTo(d16, PlanarKeys(d, z)), d16, keys + i);
    } else {
      hn::StoreU(hn::DemoteTo(d16, CocKeys(d, z)), d16, keys + i);
    }
  }
}

void DepthKeys(DepthKind kind, const float* depth, int n, std::uint16_t* keys) {
  const auto vectors = [&](const float* in, std::uint16_t* out) {
    if (kind == DepthKind::planar) {
      KeyVectors<DepthKind::planar>(in, n, out);
    } else {
      KeyVectors<DepthKind::coc>(in, n, out);
    }
  };
  if (n == kMost) return vectors(depth, keys);
  float padded[kMost] = {};
  std::uint16_t out[kMost];
  std::copy_n(depth, n, padded);
  vectors(padded, out);
  std::copy_n(out, n, keys);
}

ValueRange RangeOfCell(const std::uint16_t* values, std::ptrdiff_t stride, int rows) {
  const hn::CappedTag<std::uint16_t, kCellWidth> d;
  constexpr int step = static_cast<int>(hn::MaxLanes(d));
  ValueRange range{0xffff, 0};
  std::uint16_t least[step], most[step];
  for (int x = 0; x < kCellWidth; x += step) {
    auto low = hn::LoadU(d, values + x), high = low;
    for (int y = 1; y < rows; ++y) {
      const auto value = hn::LoadU(d, values + x + y * stride);
      low = hn::Min(low, value);
      high = hn::Max(high, value);
    }
    hn::StoreU(low, d, least);
    hn::StoreU(high, d, most);
    for (int i = 0; i < step; ++i) {
      range.least = std::min(range.least, least[i]);
      range.most = std::max(range.most, most[i]);
    }
  }
  return range;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(DepthKeys);
HWY_EXPORT(RangeOfCell);

void depth_keys(DepthKind kind, const float* depth, int n, std::uint16_t* keys) noexcept {
  HWY_DYNAMIC_DISPATCH(DepthKeys)(kind, depth, n, keys);
}

ValueRange range_of_cell(const std::uint16_t* values, std::ptrdiff_t stride, int rows) noexcept {
  return HWY_DYNAMIC_DISPATCH(RangeOfCell)(values, stride, rows);
}

}  // namespace pullfocus
#endif
