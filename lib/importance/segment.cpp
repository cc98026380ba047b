#include "importance/segment.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "importance/segment.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// One vector of depths to signed diameters (see CocFunction) before artistic scaling, background resolved.
template <DepthKind kind, class D>
HWY_INLINE hn::Vec<D> LensDiameters(D d, const CocFunction& coc, hn::Vec<D> depth) {
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  if constexpr (kind == DepthKind::coc) {
    return hn::IfThenElseZero(hn::Lt(hn::Abs(depth), infinity), depth);
  } else {
    const auto is_surface = hn::And(hn::Gt(depth, hn::Zero(d)), hn::Lt(depth, hn::Set(d, planar_background_from)));
    const auto inverse = hn::Div(hn::Set(d, 1.f), hn::IfThenElse(is_surface, depth, infinity));
    return hn::Mul(hn::Set(d, coc.scale), hn::Sub(hn::Set(d, coc.inverse_focus), inverse));
  }
}

// A background of kind coc has diameter 0, which no factor changes. Factors of 1 are left out: finding what changed
// would be slower for them.
template <DepthKind kind, bool scaled, class D>
HWY_INLINE hn::Vec<D> Diameters(D d, const CocFunction& coc, hn::Vec<D> depth) {
  const auto zero = hn::Zero(d), c = LensDiameters<kind>(d, coc, depth);
  if constexpr (!scaled) return c;
  const auto factor =
      hn::IfThenElse(hn::Lt(c, zero), hn::Set(d, coc.artistic.in_front), hn::Set(d, coc.artistic.behind));
  return hn::IfThenElseZero(hn::Ne(factor, zero), hn::Mul(c, factor));
}

// `count` depths, a multiple of the vector length, of which the first n count in the findings' sum.
template <DepthKind kind, bool scaled, bool partial>
HWY_INLINE SegmentFindings IndexVectors(const DepthToIndex& to_index, const float* depth, int count, int n,
                                        std::int16_t* index) {
  const hn::CappedTag<float, kTileWidth> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto max_diameter = hn::Set(d, to_index.max_diameter);
  const auto suspect_to =
      hn::Set(d, kind == DepthKind::coc ? -std::numeric_limits<float>::infinity() : 0.f);  // NaN is not above it either
  auto sane = hn::Eq(hn::Zero(di), hn::Zero(di));
  auto clamped = hn::Zero(di), largest = hn::Zero(di);
  for (int i = 0; i < count; i += lanes) {
    const auto z = hn::LoadU(d, depth + i);
    sane = hn::And(sane, hn::RebindMask(di, hn::Gt(z, suspect_to)));
    const auto c = Diameters<kind, scaled>(d, to_index.coc, z);
    const auto size = hn::Abs(c);
    auto is_clamped = hn::RebindMask(di, hn::Gt(size, max_diameter));
    if constexpr (partial)
      is_clamped = hn::And(is_clamped, hn::FirstN(di, static_cast<std::size_t>(std::max(n - i, 0))));
    clamped = hn::Sub(clamped, hn::VecFromMask(di, is_clamped));
    const auto kept = hn::IfThenElse(hn::Lt(size, max_diameter), size, max_diameter);
    const auto cell = hn::ConvertTo(di, hn::Mul(kept, hn::Set(d, CocTable::kCellsPerPixel)));
    const auto magnitude = hn::GatherIndex(di, to_index.cells, cell);
    largest = hn::Max(largest, magnitude);
    const auto is_negative = hn::RebindMask(di, hn::Lt(c, hn::Zero(d)));
    hn::StoreU(hn::DemoteTo(d16, hn::IfThenElse(is_negative, hn::Neg(magnitude), magnitude)), d16, index + i);
  }
  return {hn::GetLane(hn::SumOfLanes(di, clamped)), hn::GetLane(hn::MaxOfLanes(di, largest)), !hn::AllTrue(di, sane)};
}

template <DepthKind kind, bool scaled>
HWY_INLINE SegmentFindings Index(const DepthToIndex& to_index, const float* depth, int n, std::int16_t* index) {
  if (n == kTileWidth) return IndexVectors<kind, scaled, false>(to_index, depth, n, n, index);
  // Vectors past the end repeat the first pixel, which changes neither the largest index nor what is suspect.
  float padded[kTileWidth];
  std::copy_n(depth, n, padded);
  std::fill(padded + n, padded + kTileWidth, depth[0]);
  std::int16_t out[kTileWidth];
  const SegmentFindings findings = IndexVectors<kind, scaled, true>(to_index, padded, kTileWidth, n, out);
  std::copy_n(out, n, index);
  return findings;
}

SegmentFindings SignedIndices(const DepthToIndex& to_index, const float* depth, int n, std::int16_t* index) {
  const bool coc = to_index.coc.kind == DepthKind::coc;
  if (to_index.scaled) {
    return coc ? Index<DepthKind::coc, true>(to_index, depth, n, index)
               : Index<DepthKind::planar, true>(to_index, depth, n, index);
  }
  return coc ? Index<DepthKind::coc, false>(to_index, depth, n, index)
             : Index<DepthKind::planar, false>(to_index, depth, n, index);
}

// True if two runs of `bytes` bytes are equal.
HWY_INLINE bool Equal(const void* a, const void* b, int bytes) {
  const hn::ScalableTag<std::uint8_t> d;
  const auto* const p = static_cast<const std::uint8_t*>(a);
  const auto* const q = static_cast<const std::uint8_t*>(b);
  const int lanes = static_cast<int>(hn::Lanes(d));
  auto difference = hn::Zero(d);
  int i = 0;
  for (; i + lanes <= bytes; i += lanes) {
    difference = hn::Or(difference, hn::Xor(hn::LoadU(d, p + i), hn::LoadU(d, q + i)));
  }
  bool equal = hn::AllTrue(d, hn::Eq(difference, hn::Zero(d)));
  for (; i < bytes; ++i) equal &= p[i] == q[i];
  return equal;
}

// Bits in which two runs of `bytes` bytes, a multiple of every vector's length, differ, put together in one vector.
template <int bytes, class D = hn::ScalableTag<std::uint8_t>>
HWY_INLINE hn::Vec<D> Difference(const void* a, const void* b) {
  const D d;
  const auto* const p = static_cast<const std::uint8_t*>(a);
  const auto* const q = static_cast<const std::uint8_t*>(b);
  auto difference = hn::Zero(d);
  for (int i = 0; i < bytes; i += static_cast<int>(hn::Lanes(d))) {
    difference = hn::Or(difference, hn::Xor(hn::LoadU(d, p + i), hn::LoadU(d, q + i)));
  }
  return difference;
}

// Bit i: a[i] != b[i].
template <class T>
HWY_INLINE std::uint64_t Differing(const T* a, const T* b, int n) {
  const hn::ScalableTag<T> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::uint64_t bits = 0;
  int i = 0;
  for (; i + lanes <= n; i += lanes) {
    std::uint8_t stored[8] = {};
    const std::size_t bytes = hn::StoreMaskBits(d, hn::Ne(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), stored);
    for (std::size_t k = 0; k < bytes; ++k) bits |= std::uint64_t{stored[k]} << (i + 8 * static_cast<int>(k));
  }
  for (; i < n; ++i) bits |= std::uint64_t{a[i] != b[i]} << i;
  return bits;
}

HWY_INLINE std::uint64_t DifferingPixels(const Pixel<SampleType::half>* a, const Pixel<SampleType::half>* b, int n) {
  std::uint64_t words[2][kTileWidth];
  std::memcpy(words[0], a, static_cast<std::size_t>(n) * sizeof *a);
  std::memcpy(words[1], b, static_cast<std::size_t>(n) * sizeof *b);
  return Differing(words[0], words[1], n);
}

HWY_INLINE std::uint64_t DifferingPixels(const Pixel<SampleType::float32>* a, const Pixel<SampleType::float32>* b,
                                         int n) {
  std::uint64_t bits = 0;
  for (int i = 0; i < n; ++i) bits |= std::uint64_t{!(a[i] == b[i])} << i;
  return bits;
}

template <SampleType type>
HWY_INLINE SegmentFindings Compare(const DepthToIndex& to_index, const SegmentPair<type>& pair, std::int16_t* index,
                                   SegmentDifference& difference) {
  SegmentFindings findings;
  if (pair.known_depth != nullptr) {
    difference.known = Equal(pair.depth, pair.known_depth, pair.n * static_cast<int>(sizeof *pair.depth));
  }
  if (!difference.known) {
    findings = SignedIndices(to_index, pair.depth, pair.n, index);
    if (!Equal(index, pair.old_index, pair.n * static_cast<int>(sizeof *index))) {
      difference.index = Differing(index, pair.old_index, pair.n);
    }
  }
  if (!Equal(pair.colours, pair.old_colours, pair.n * static_cast<int>(sizeof *pair.colours))) {
    difference.colour = DifferingPixels(pair.colours, pair.old_colours, pair.n);
  }
  return findings;
}

SegmentFindings CompareHalf(const DepthToIndex& to_index, const SegmentPair<SampleType::half>& pair,
                            std::int16_t* index, SegmentDifference& difference) {
  return Compare(to_index, pair, index, difference);
}
SegmentFindings CompareFloat(const DepthToIndex& to_index, const SegmentPair<SampleType::float32>& pair,
                             std::int16_t* index, SegmentDifference& difference) {
  return Compare(to_index, pair, index, difference);
}

template <SampleType type>
HWY_INLINE int Unchanged(const SegmentPair<type>& first, int count) {
  const hn::ScalableTag<std::uint8_t> d;
  constexpr int colour_bytes = kTileWidth * sizeof *first.colours, depth_bytes = kTileWidth * sizeof *first.depth;
  for (int s = 0; s < count; ++s) {
    const int at = s * kTileWidth;
    const auto difference = hn::Or(Difference<colour_bytes>(first.colours + at, first.old_colours + at),
                                   Difference<depth_bytes>(first.depth + at, first.known_depth + at));
    if (!hn::AllTrue(d, hn::Eq(difference, hn::Zero(d)))) return s;
  }
  return count;
}

int UnchangedHalf(const SegmentPair<SampleType::half>& first, int count) { return Unchanged(first, count); }
int UnchangedFloat(const SegmentPair<SampleType::float32>& first, int count) { return Unchanged(first, count); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(SignedIndices);
HWY_EXPORT(CompareHalf);
HWY_EXPORT(CompareFloat);
HWY_EXPORT(UnchangedHalf);
HWY_EXPORT(UnchangedFloat);

SegmentFindings signed_indices(const DepthToIndex& to_index, const float* depth, int n, std::int16_t* index) noexcept {
  return HWY_DYNAMIC_DISPATCH(SignedIndices)(to_index, depth, n, index);
}

template <SampleType type>
SegmentFindings compare(const DepthToIndex& to_index, const SegmentPair<type>& pair, std::int16_t* index,
                        SegmentDifference& difference) noexcept {
  if constexpr (type == SampleType::half) {
    return HWY_DYNAMIC_DISPATCH(CompareHalf)(to_index, pair, index, difference);
  } else {
    return HWY_DYNAMIC_DISPATCH(CompareFloat)(to_index, pair, index, difference);
  }
}

template <SampleType type>
int unchanged_segments(const SegmentPair<type>& first, int count) noexcept {
  if constexpr (type == SampleType::half) {
    return HWY_DYNAMIC_DISPATCH(UnchangedHalf)(first, count);
  } else {
    return HWY_DYNAMIC_DISPATCH(UnchangedFloat)(first, count);
  }
}

template SegmentFindings compare(const DepthToIndex&, const SegmentPair<SampleType::half>&, std::int16_t*,
                                 SegmentDifference&) noexcept;
template SegmentFindings compare(const DepthToIndex&, const SegmentPair<SampleType::float32>&, std::int16_t*,
                                 SegmentDifference&) noexcept;
template int unchanged_segments(const SegmentPair<SampleType::half>&, int) noexcept;
template int unchanged_segments(const SegmentPair<SampleType::float32>&, int) noexcept;

}  // namespace pullfocus
#endif
