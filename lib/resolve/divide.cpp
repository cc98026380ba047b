#include "resolve/divide.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "resolve/divide.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "resolve/pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Reciprocals of the weights of n <= kChunk pixels. Returns false if a weight is 0.
template <int lanes>
HWY_INLINE bool Reciprocals(const Accumulator* values, int n, double* HWY_RESTRICT out) {
  const hn::CappedTag<double, kChunk> d;
  const int step = static_cast<int>(hn::Lanes(d));
  const auto* weights = reinterpret_cast<const std::int64_t*>(values + kWeightLane);
  const auto one = hn::Set(d, 1.0);
  auto positive = hn::Eq(one, one);
  int i = 0;
  for (; i + step <= n; i += step) {
    const auto weight = WeightsOf<lanes>(d, values + static_cast<std::ptrdiff_t>(i) * lanes);
    positive = hn::And(positive, hn::Ne(weight, hn::Zero(d)));
    hn::StoreU(hn::Div(one, weight), d, out + i);
  }
  bool all = hn::AllTrue(d, positive);
  for (; i < n; ++i) {
    const std::int64_t weight = weights[static_cast<std::ptrdiff_t>(i) * lanes];
    all &= weight != 0;
    out[i] = 1.0 / static_cast<double>(weight);
  }
  return all;
}

// RGBA of n pixels: sums times reciprocals.
template <int lanes>
HWY_INLINE void Divide(const Accumulator* values, const double* scale, int n, float* HWY_RESTRICT out) {
  const hn::CappedTag<double, 4> d;
  const hn::Repartition<std::int64_t, decltype(d)> di;
  const hn::Rebind<float, decltype(d)> df;
  constexpr int step = static_cast<int>(hn::MaxLanes(d));
  for (int i = 0; i < n; ++i, values += lanes) {
    const auto* sums = reinterpret_cast<const std::int64_t*>(values);
    for (int k = 0; k < 4; k += step) {
      const auto is_colour = hn::FirstN(di, static_cast<std::size_t>(3 - k));
      auto sum = hn::LoadU(di, sums + k);
      // One further on, the alpha lane comes to lie where the weight was.
      if constexpr (lanes == kAlphaLanes) sum = hn::IfThenElse(is_colour, sum, hn::LoadU(di, sums + k + 1));
      auto quotient = hn::DemoteTo(df, hn::Mul(hn::ConvertTo(d, sum), hn::Set(d, scale[i])));
      if constexpr (lanes == kOpaqueLanes) {
        quotient = hn::IfThenElse(hn::FirstN(df, static_cast<std::size_t>(3 - k)), quotient, hn::Set(df, 1.f));
      }
      hn::StoreU(quotient, df, out + 4 * i + k);
    }
  }
}

// A vector of two pixels of four lanes, stored.
template <class D>
HWY_INLINE void StorePair(D d, hn::Vec<D> colours, Pixel<SampleType::half>* out) {
  const auto clamped = hn::Min(hn::Max(colours, hn::Set(d, -65504.f)), hn::Set(d, 65504.f));
  hn::StoreU(HalfFromFloat(d, clamped), hn::Rebind<std::uint16_t, D>(), reinterpret_cast<std::uint16_t*>(out));
}
template <class D>
HWY_INLINE void StorePair(D d, hn::Vec<D> colours, Pixel<SampleType::float32>* out) {
  hn::StoreU(colours, d, reinterpret_cast<float*>(out));
}

// Pixels of four lanes, where a vector holds two of them: eight at a time, from sums to colours without a detour by
// memory, as far as n goes. Returns how many were done; clears `all` if one had no weight.
//
// Pair k's weights, lanes 3 and 7, are turned to lanes 3 - k and 7 - k, so that one division serves all pairs.
template <SampleType type>
HWY_INLINE int ResolveInPairs(const Accumulator* values, int n, Pixel<type>* out, bool& all) {
  const hn::CappedTag<double, 2 * kOpaqueLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<float, decltype(d)> df;
  constexpr int pairs = kOpaqueLanes, step = 2 * pairs;
  const auto* sums = reinterpret_cast<const std::int64_t*>(values);
  const auto lane = hn::Iota(di, 0), three = hn::Set(di, 3);
  const auto block = hn::AndNot(three, lane), in_block = hn::And(lane, three);
  const auto is_alpha = AlphaOfPair(df);
  const auto one = hn::Set(d, 1.0);
  auto positive = hn::Eq(one, one);
  int i = 0;
  for (; i + step <= n; i += step, sums += step * kOpaqueLanes) {
    hn::Vec<decltype(d)> pair[pairs];
    auto weights = one;
    for (int k = 0; k < pairs; ++k) {
      pair[k] = hn::ConvertTo(d, hn::LoadU(di, sums + 2 * k * kOpaqueLanes));
      const auto is_here = hn::RebindMask(d, hn::Eq(in_block, hn::Set(di, std::int64_t{3 - k})));
      const auto of_block = hn::TableLookupLanes(pair[k], hn::IndicesFromVec(d, hn::Or(block, three)));
      weights = hn::IfThenElse(is_here, of_block, weights);
    }
    positive = hn::And(positive, hn::Ne(weights, hn::Zero(d)));
    const auto scales = hn::Div(one, weights);
    for (int k = 0; k < pairs; ++k) {
      const auto own = hn::IndicesFromVec(d, hn::Or(block, hn::Set(di, std::int64_t{3 - k})));
      const auto colours = hn::Mul(pair[k], hn::TableLookupLanes(scales, own));
      StorePair(df, hn::IfThenElse(is_alpha, hn::Set(df, 1.f), hn::DemoteTo(df, colours)), out + i + 2 * k);
    }
  }
  all = all && hn::AllTrue(d, positive);
  return i;
}

template <SampleType type, int lanes>
bool Resolve(const Accumulator* values, int n, void* pixels) {
  auto* out = static_cast<Pixel<type>*>(pixels);
  double scale[kChunk];
  float colours[4 * kChunk] = {};
  bool all = true;
  int i = 0;
  if constexpr (in_pairs<lanes>) {
    i = ResolveInPairs<type>(values, n, out, all);
    values += static_cast<std::ptrdiff_t>(i) * lanes;
  }
  for (; i < n; i += kChunk, values += kChunk * lanes) {
    const int count = std::min(kChunk, n - i);
    all &= Reciprocals<lanes>(values, count, scale);
    Divide<lanes>(values, scale, count, colours);
    Store(colours, count, out + i);
  }
  return all;
}

// False if a pixel had no weight: it was given no meaningful value.
bool ResolveSpan(const Accumulator* values, int lanes, int n, SampleType type, void* pixels) {
  if (type == SampleType::half) {
    return lanes == kOpaqueLanes ? Resolve<SampleType::half, kOpaqueLanes>(values, n, pixels)
                                 : Resolve<SampleType::half, kAlphaLanes>(values, n, pixels);
  }
  return lanes == kOpaqueLanes ? Resolve<SampleType::float32, kOpaqueLanes>(values, n, pixels)
                               : Resolve<SampleType::float32, kAlphaLanes>(values, n, pixels);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(ResolveSpan);

bool divide(const Accumulator* values, int lanes, int n, SampleType type, void* pixels) noexcept {
  return HWY_DYNAMIC_DISPATCH(ResolveSpan)(values, lanes, n, type, pixels);
}

}  // namespace pullfocus
#endif
