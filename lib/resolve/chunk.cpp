#include "resolve/chunk.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "image/sanitise.h"
#include "resolve/resolve.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "resolve/chunk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/convert-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk = Backdrop::kChunk;  // pixels divided before they are stored
constexpr double kUnit = static_cast<double>(kCoveringWeight);

// Reciprocals of the weights of n <= kChunk pixels. Returns false if a weight is 0.
template <int lanes>
HWY_INLINE bool Reciprocals(const Accumulator* values, int n, double* HWY_RESTRICT out) {
  const hn::CappedTag<double, kChunk> d;
  const hn::RebindToSigned<decltype(d)> di;
  const int step = static_cast<int>(hn::Lanes(d));
  const auto* weights = reinterpret_cast<const std::int64_t*>(values + kWeightLane);
  const auto one = hn::Set(d, 1.0);
  std::int64_t offsets[kChunk];
  for (int k = 0; k < step; ++k) offsets[k] = std::int64_t{k} * lanes;
  const auto offset = hn::LoadU(di, offsets);
  auto positive = hn::Eq(one, one);
  int i = 0;
  for (; i + step <= n; i += step) {
    const auto weight = hn::ConvertTo(d, hn::GatherIndex(di, weights + static_cast<std::ptrdiff_t>(i) * lanes, offset));
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
  const hn::RebindToSigned<decltype(df)> df_bits;
  constexpr int pairs = kOpaqueLanes, step = 2 * pairs;
  const auto* sums = reinterpret_cast<const std::int64_t*>(values);
  const auto lane = hn::Iota(di, 0), three = hn::Set(di, 3);
  const auto block = hn::AndNot(three, lane), in_block = hn::And(lane, three);
  const auto float_three = hn::Set(df_bits, 3);
  const auto is_alpha = hn::RebindMask(df, hn::Eq(hn::And(hn::Iota(df_bits, 0), float_three), float_three));
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
  constexpr bool in_pairs =
      lanes == kOpaqueLanes && hn::MaxLanes(hn::CappedTag<double, 2 * kOpaqueLanes>()) == 2 * kOpaqueLanes;
  auto* out = static_cast<Pixel<type>*>(pixels);
  double scale[kChunk];
  float colours[4 * kChunk] = {};
  bool all = true;
  int i = 0;
  if constexpr (in_pairs) {
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

// What n <= kChunk pixels take of each layer.
struct Shares {
  double of[kMostLayers][kChunk];       // factor of the layer's sums
  double free[kChunk];                  // what the layers leave of a unit, before the farthest takes it
  double near[kChunk], behind[kChunk];  // weights of the layers in front of focus, and of the others
};

// Pixels i .. i + Lanes(d) - 1. Returns whether all have a weight.
template <int lanes, class D>
HWY_INLINE bool AcceptVector(D d, const Accumulator* const* layers, std::size_t count, std::size_t near, int i,
                             Shares& shares) {
  const hn::RebindToSigned<D> di;
  std::int64_t offsets[kChunk];
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) offsets[k] = static_cast<std::int64_t>(k) * lanes;
  const auto offset = hn::LoadU(di, offsets);
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  auto free = hn::Set(d, kUnit), reached = zero, in_front = zero, behind = zero;
  double weights[kMostLayers][kChunk];
  for (std::size_t l = 0; l < count; ++l) {
    const auto* first = reinterpret_cast<const std::int64_t*>(layers[l] + static_cast<std::ptrdiff_t>(i) * lanes);
    const auto weight = hn::ConvertTo(d, hn::GatherIndex(di, first + kWeightLane, offset));
    const auto taken = hn::Min(weight, free);
    free = hn::Sub(free, taken);
    reached = hn::Add(reached, hn::IfThenElseZero(hn::Ne(weight, zero), one));
    if (l < near) {
      in_front = hn::Add(in_front, weight);
    } else {
      behind = hn::Add(behind, weight);
    }
    hn::StoreU(weight, d, weights[l]);
    hn::StoreU(taken, d, shares.of[l] + i);
  }
  const auto alone = hn::Eq(reached, one);
  auto rest = free;
  for (std::size_t l = count; l-- > 0;) {
    const auto weight = hn::LoadU(d, weights[l]);
    const auto has_weight = hn::Ne(weight, zero);
    const auto taken = hn::Add(hn::LoadU(d, shares.of[l] + i), rest);
    rest = hn::IfThenElse(has_weight, zero, rest);
    const auto part = hn::IfThenElse(alone, one, hn::Mul(taken, hn::Set(d, 1.0 / kUnit)));
    hn::StoreU(hn::IfThenElseZero(has_weight, hn::Div(part, weight)), d, shares.of[l] + i);
  }
  hn::StoreU(hn::Mul(free, hn::Set(d, 1.0 / kUnit)), d, shares.free + i);
  hn::StoreU(in_front, d, shares.near + i);
  hn::StoreU(behind, d, shares.behind + i);
  return hn::AllFalse(d, hn::Eq(reached, zero));
}

template <int lanes>
HWY_INLINE bool Accept(const Accumulator* const* layers, std::size_t count, std::size_t near, int n, Shares& shares) {
  const hn::CappedTag<double, kChunk> d;
  const hn::CappedTag<double, 1> one;
  const int step = static_cast<int>(hn::Lanes(d));
  bool all = true;
  int i = 0;
  for (; i + step <= n; i += step) all &= AcceptVector<lanes>(d, layers, count, near, i, shares);
  for (; i < n; ++i) all &= AcceptVector<lanes>(one, layers, count, near, i, shares);
  return all;
}

// RGBA of n pixels: the layers' sums times their shares.
template <int lanes>
HWY_INLINE void Blend(const Accumulator* const* layers, std::size_t count, const Shares& shares, int n,
                      float* HWY_RESTRICT out) {
  const hn::CappedTag<double, 4> d;
  const hn::Repartition<std::int64_t, decltype(d)> di;
  const hn::Rebind<float, decltype(d)> df;
  constexpr int step = static_cast<int>(hn::MaxLanes(d));
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 4; k += step) {
      const auto is_colour = hn::FirstN(di, static_cast<std::size_t>(3 - k));
      auto colour = hn::Zero(d);
      for (std::size_t l = 0; l < count; ++l) {
        const auto* sums = reinterpret_cast<const std::int64_t*>(layers[l] + static_cast<std::ptrdiff_t>(i) * lanes);
        auto sum = hn::LoadU(di, sums + k);
        if constexpr (lanes == kAlphaLanes) sum = hn::IfThenElse(is_colour, sum, hn::LoadU(di, sums + k + 1));
        colour = hn::Add(colour, hn::Mul(hn::ConvertTo(d, sum), hn::Set(d, shares.of[l][i])));
      }
      auto value = hn::DemoteTo(df, colour);
      if constexpr (lanes == kOpaqueLanes) {
        value = hn::IfThenElse(hn::FirstN(df, static_cast<std::size_t>(3 - k)), value, hn::Set(df, 1.f));
      }
      hn::StoreU(value, df, out + 4 * i + k);
    }
  }
}

// What the backdrop is to know of the pixels, `colours` being what they were given.
template <int lanes>
HWY_INLINE void Look(const Accumulator* const* layers, std::size_t count, std::size_t near, int n, Shares& shares,
                     const float* colours, Backdrop::Chunk& chunk) {
  for (int i = 0; i < n; ++i) {
    const bool in_front = shares.near[i] > 0;
    const bool hole = in_front && shares.behind[i] == 0 && shares.free[i] > Backdrop::kLeastFree;
    const bool shows = in_front && shares.behind[i] >= Backdrop::kEnoughBehind * kUnit;
    chunk.holes |= std::uint32_t{hole} << i;
    chunk.shows |= std::uint32_t{shows} << i;
    chunk.amount[i] = static_cast<float>(std::min(shares.free[i], 2 * (shares.free[i] - Backdrop::kLeastFree)));
  }
  if (chunk.shows != 0) {
    Accept<lanes>(layers + near, count - near, 0, n, shares);
    Blend<lanes>(layers + near, count - near, shares, n, chunk.colour[0]);
  }
  for (std::uint32_t bits = chunk.holes; bits != 0; bits &= bits - 1) {
    const int i = std::countr_zero(bits);
    std::copy_n(colours + 4 * i, 4, chunk.colour[i]);
  }
}

template <SampleType type, int lanes>
bool Compose(const Accumulator* const* layers, std::size_t count, std::size_t near, int n, void* pixels,
             Backdrop::Chunk* chunk) {
  Shares shares;
  float colours[4 * kChunk] = {};
  const bool all = Accept<lanes>(layers, count, near, n, shares);
  Blend<lanes>(layers, count, shares, n, colours);
  Store(colours, n, static_cast<Pixel<type>*>(pixels));
  if (chunk != nullptr) Look<lanes>(layers, count, near, n, shares, colours, *chunk);
  return all;
}

bool ComposeChunk(const Accumulator* const* layers, std::size_t count, std::size_t near, int lanes, int n,
                  SampleType type, void* pixels, Backdrop::Chunk* chunk) {
  if (type == SampleType::half) {
    return lanes == kOpaqueLanes ? Compose<SampleType::half, kOpaqueLanes>(layers, count, near, n, pixels, chunk)
                                 : Compose<SampleType::half, kAlphaLanes>(layers, count, near, n, pixels, chunk);
  }
  return lanes == kOpaqueLanes ? Compose<SampleType::float32, kOpaqueLanes>(layers, count, near, n, pixels, chunk)
                               : Compose<SampleType::float32, kAlphaLanes>(layers, count, near, n, pixels, chunk);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(ResolveSpan);
HWY_EXPORT(ComposeChunk);

bool divide(const Accumulator* values, int lanes, int n, SampleType type, void* pixels) noexcept {
  return HWY_DYNAMIC_DISPATCH(ResolveSpan)(values, lanes, n, type, pixels);
}

bool compose(std::span<const Accumulator* const> layers, std::size_t near, int lanes, int n, SampleType type,
             void* pixels, Backdrop::Chunk* chunk) noexcept {
  return HWY_DYNAMIC_DISPATCH(ComposeChunk)(layers.data(), layers.size(), near, lanes, n, type, pixels, chunk);
}

}  // namespace pullfocus
#endif
