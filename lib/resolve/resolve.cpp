#include "resolve/resolve.h"

#include <algorithm>
#include <cstring>

#include "image/sanitise.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "resolve/resolve.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/convert-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk = 32;  // pixels divided before they are stored

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

template <SampleType type, int lanes>
bool Resolve(const Accumulator* values, int n, void* pixels) {
  auto* out = static_cast<Pixel<type>*>(pixels);
  double scale[kChunk];
  float colours[4 * kChunk] = {};
  bool all = true;
  for (int i = 0; i < n; i += kChunk, values += kChunk * lanes) {
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

void resolve_span(const Accumulator* values, int lanes, int x0, int x1, int y, const ColourImage& own,
                  ColourImage& out) noexcept {
  const int x = out.window().x0 + x0, row = out.window().y0 + y;
  if (HWY_DYNAMIC_DISPATCH(ResolveSpan)(values, lanes, x1 - x0, out.type(), out.pixel(x, row))) return;
  for (int i = 0; i < x1 - x0; ++i, values += lanes) {
    if (values[kWeightLane] != 0) continue;
    for (int c = 0; c < 4; ++c) {
      const float value = own.get(x + i, row, c);
      out.set(x + i, row, c, out.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
    }
  }
}

}  // namespace pullfocus
#endif
