// Accumulator lanes of one source. Included once per SIMD target (see Highway's foreach_target.h).
#if defined(PULLFOCUS_SCATTER_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PULLFOCUS_SCATTER_LANES_INL_H_
#undef PULLFOCUS_SCATTER_LANES_INL_H_
#else
#define PULLFOCUS_SCATTER_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>

#include "scatter/band.h"
#include "simd/convert-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Calls part(d, i) for vectors of tag d that cover n values, i the first value of each: the widest first.
template <int n, int first = 0, class Part>
HWY_INLINE void ForEachPart(Part&& part) {
  if constexpr (first < n) {
    constexpr auto left = static_cast<std::size_t>(n - first);
    const hn::CappedTag<Accumulator, std::bit_floor(left)> d;
    constexpr int step = static_cast<int>(hn::MaxLanes(d));
    constexpr int end = first + static_cast<int>(left) / step * step;
    for (int i = first; i < end; i += step) part(d, i);
    ForEachPart<n, end>(part);
  }
}

// round(plus * weight) - round(minus * weight). Products are rounded to doubles and then to integers by the default
// mode: one value on every target.
template <bool with_minus, class D>
HWY_INLINE auto Contribution(D d, const double* plus, const double* minus, double weight) {
  const auto w = hn::Set(d, weight);
  const auto added = RoundToInt64(d, hn::Mul(hn::LoadU(d, plus), w));
  if constexpr (!with_minus) {
    return hn::BitCast(hn::RebindToUnsigned<D>(), added);
  } else {
    const auto removed = RoundToInt64(d, hn::Mul(hn::LoadU(d, minus), w));
    return hn::BitCast(hn::RebindToUnsigned<D>(), hn::Sub(added, removed));
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
