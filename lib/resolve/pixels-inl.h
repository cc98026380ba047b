// Steps from sums to pixels. Included once per SIMD target (see Highway's foreach_target.h).
#if defined(PULLFOCUS_RESOLVE_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PULLFOCUS_RESOLVE_PIXELS_INL_H_
#undef PULLFOCUS_RESOLVE_PIXELS_INL_H_
#else
#define PULLFOCUS_RESOLVE_PIXELS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstring>

#include "image/frame.h"
#include "image/sanitise.h"
#include "resolve/backdrop.h"
#include "scatter/band.h"
#include "simd/convert-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk = Backdrop::kChunk;  // pixels divided before they are stored

// Whether a vector holds two pixels of so many lanes.
template <int lanes>
constexpr bool in_pairs =
    lanes == kOpaqueLanes && hn::MaxLanes(hn::CappedTag<double, 2 * kOpaqueLanes>()) == 2 * kOpaqueLanes;

// The lanes of alpha where a vector holds two pixels.
template <class D>
HWY_INLINE hn::Mask<D> AlphaOfPair(D d) {
  const hn::RebindToSigned<D> bits;
  const auto three = hn::Set(bits, 3);
  return hn::RebindMask(d, hn::Eq(hn::And(hn::Iota(bits, 0), three), three));
}

// Weights of as many pixels as a vector has lanes.
template <int lanes, class D>
HWY_INLINE hn::Vec<D> WeightsOf(D d, const Accumulator* values) {
  const hn::RebindToSigned<D> di;
  const auto* sums = reinterpret_cast<const std::int64_t*>(values);
#if HWY_TARGET != HWY_SCALAR
  if constexpr (in_pairs<lanes> && hn::MaxLanes(D()) == 2 * kOpaqueLanes) {  // every fourth of 32: faster than a gather
    const auto pair = [&](int k) HWY_ATTR { return hn::LoadU(di, sums + 2 * k * kOpaqueLanes); };
    const auto left = hn::ConcatOdd(di, pair(1), pair(0)), right = hn::ConcatOdd(di, pair(3), pair(2));
    return hn::ConvertTo(d, hn::ConcatOdd(di, right, left));
  }
#endif
  std::int64_t offsets[kChunk];
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) offsets[k] = static_cast<std::int64_t>(k) * lanes;
  return hn::ConvertTo(d, hn::GatherIndex(di, sums + kWeightLane, hn::LoadU(di, offsets)));
}

// Halves of 4 * n floats, clamped; `in` has room for 4 * kChunk.
HWY_INLINE void Store(const float* in, int n, Pixel<SampleType::half>* out) {
  const hn::CappedTag<float, 4 * kChunk> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  const int step = static_cast<int>(hn::Lanes(d));
  std::uint16_t halves[4 * kChunk];
  for (int i = 0; i < 4 * n; i += step) {
    const auto clamped = hn::Min(hn::Max(hn::LoadU(d, in + i), hn::Set(d, -65504.f)), hn::Set(d, 65504.f));
    hn::StoreU(HalfFromFloat(d, clamped), d16, halves + i);
  }
  std::memcpy(out, halves, static_cast<std::size_t>(n) * sizeof *out);
}
HWY_INLINE void Store(const float* in, int n, Pixel<SampleType::float32>* out) {
  std::memcpy(out, in, static_cast<std::size_t>(n) * sizeof *out);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
