#include "resolve/compose.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "resolve/resolve.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "resolve/compose.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "resolve/pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr double kUnit = static_cast<double>(kCoveringWeight);

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
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  auto free = hn::Set(d, kUnit), reached = zero, in_front = zero, behind = zero;
  double weights[kMostLayers][kChunk];
  for (std::size_t l = 0; l < count; ++l) {
    const auto weight = WeightsOf<lanes>(d, layers[l] + static_cast<std::ptrdiff_t>(i) * lanes);
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

// The same as Blend() does, two pixels a vector, for as many pixels as vectors of shares are full of. Returns how many.
HWY_INLINE int BlendInPairs(const Accumulator* const* layers, std::size_t count, const Shares& shares, int n,
                            float* HWY_RESTRICT out) {
  const hn::CappedTag<double, 2 * kOpaqueLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<float, decltype(d)> df;
  constexpr int pairs = kOpaqueLanes, step = 2 * pairs;
  const auto right = hn::ShiftRight<2>(hn::Iota(di, 0));  // 1 in the lanes of a pair's second pixel
  const auto is_alpha = AlphaOfPair(df);
  int i = 0;
  for (; i + step <= n; i += step) {
    hn::Vec<decltype(d)> colours[pairs];
    for (auto& pair : colours) pair = hn::Zero(d);
    for (std::size_t l = 0; l < count; ++l) {
      const auto* sums =
          reinterpret_cast<const std::int64_t*>(layers[l] + static_cast<std::ptrdiff_t>(i) * kOpaqueLanes);
      const auto of_layer = hn::LoadU(d, shares.of[l] + i);
      for (int k = 0; k < pairs; ++k) {
        const auto own = hn::IndicesFromVec(d, hn::Add(right, hn::Set(di, std::int64_t{2 * k})));
        const auto sum = hn::ConvertTo(d, hn::LoadU(di, sums + 2 * k * kOpaqueLanes));
        colours[k] = hn::Add(colours[k], hn::Mul(sum, hn::TableLookupLanes(of_layer, own)));
      }
    }
    for (int k = 0; k < pairs; ++k) {
      hn::StoreU(hn::IfThenElse(is_alpha, hn::Set(df, 1.f), hn::DemoteTo(df, colours[k])), df, out + 4 * i + 8 * k);
    }
  }
  return i;
}

// RGBA of n pixels: the layers' sums times their shares.
template <int lanes>
HWY_INLINE void Blend(const Accumulator* const* layers, std::size_t count, const Shares& shares, int n,
                      float* HWY_RESTRICT out) {
  const hn::CappedTag<double, 4> d;
  const hn::Repartition<std::int64_t, decltype(d)> di;
  const hn::Rebind<float, decltype(d)> df;
  constexpr int step = static_cast<int>(hn::MaxLanes(d));
  int i = 0;
  if constexpr (in_pairs<lanes>) i = BlendInPairs(layers, count, shares, n, out);
  for (; i < n; ++i) {
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

// What the backdrop is to know of pixels i .. i + Lanes(d) - 1, but for their colours.
template <class D>
HWY_INLINE void LookAtVector(D d, int i, const Shares& shares, Backdrop::Chunk& chunk) {
  const hn::Rebind<float, D> df;
  const auto zero = hn::Zero(d), least = hn::Set(d, Backdrop::kLeastFree);
  const auto free = hn::LoadU(d, shares.free + i), behind = hn::LoadU(d, shares.behind + i);
  const auto in_front = hn::Gt(hn::LoadU(d, shares.near + i), zero);
  const auto hole = hn::And(in_front, hn::And(hn::Eq(behind, zero), hn::Gt(free, least)));
  const auto shows = hn::And(in_front, hn::Ge(behind, hn::Set(d, Backdrop::kEnoughBehind * kUnit)));
  const auto bits = [&](auto mask) HWY_ATTR {
    std::uint8_t stored[8] = {};
    hn::StoreMaskBits(d, mask, stored);
    return std::uint32_t{stored[0]} << i;
  };
  chunk.holes |= bits(hole);
  chunk.shows |= bits(shows);
  const auto beyond = hn::Sub(free, least);
  hn::StoreU(hn::DemoteTo(df, hn::Min(free, hn::Add(beyond, beyond))), df, chunk.amount + i);
}

// What the backdrop is to know of the pixels, `colours` being what they were given.
template <int lanes>
HWY_INLINE void Look(const Accumulator* const* layers, std::size_t count, std::size_t near, int n, Shares& shares,
                     const float* colours, Backdrop::Chunk& chunk) {
  const hn::CappedTag<double, 8> d;  // lanes' bits fill a byte at most
  const hn::CappedTag<double, 1> one;
  const int step = static_cast<int>(hn::Lanes(d));
  int i = 0;
  for (; i + step <= n; i += step) LookAtVector(d, i, shares, chunk);
  for (; i < n; ++i) LookAtVector(one, i, shares, chunk);
  if (chunk.shows != 0) {
    Accept<lanes>(layers + near, count - near, 0, n, shares);
    Blend<lanes>(layers + near, count - near, shares, n, chunk.colour[0]);
  }
  for (std::uint32_t bits = chunk.holes; bits != 0; bits &= bits - 1) {
    const int hole = std::countr_zero(bits);
    std::copy_n(colours + 4 * hole, 4, chunk.colour[hole]);
  }
}

template <SampleType type, int lanes>
bool Compose(const Accumulator* const* layers, std::size_t count, std::size_t near, int n, void* pixels,
             Backdrop::Chunk* chunk) {
  Shares shares;
  float colours[4 * kChunk];
  std::fill(colours + 4 * n, std::end(colours), 0.f);  // whole vectors are converted
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

HWY_EXPORT(ComposeChunk);

bool compose(std::span<const Accumulator* const> layers, std::size_t near, int lanes, int n, SampleType type,
             void* pixels, Backdrop::Chunk* chunk) noexcept {
  return HWY_DYNAMIC_DISPATCH(ComposeChunk)(layers.data(), layers.size(), near, lanes, n, type, pixels, chunk);
}

}  // namespace pullfocus
#endif
