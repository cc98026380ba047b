#include "resolve/resolve.h"

#include <algorithm>
#include <cstring>
#include <limits>

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

// Which of the layers reach a pixel (none: first > last), and what they leave free of a unit that covers it.
struct Reached {
  std::size_t first = 1, last = 0;
  double free = 1;
};

constexpr double kUnit = static_cast<double>(kCoveringWeight);

// One pixel of several layers, whose sums are given.
template <int lanes>
HWY_INLINE Reached Combine(const std::int64_t* const* layers, std::size_t count, std::size_t at,
                           float* HWY_RESTRICT out) {
  Reached reached;
  std::size_t n = 0;
  for (std::size_t l = 0; l < count; ++l) {
    if (layers[l][at + kWeightLane] == 0) continue;
    if (n++ == 0) reached.first = l;
    reached.last = l;
  }
  if (n == 0) return reached;
  const std::int64_t* const farthest = layers[reached.last] + at;
  double colour[4] = {}, scale = 0;
  if (n == 1) {
    const double weight = static_cast<double>(farthest[kWeightLane]);
    scale = 1.0 / weight;
    for (int c = 0; c < 3; ++c) colour[c] = static_cast<double>(farthest[c]);
    if constexpr (lanes == kAlphaLanes) colour[3] = static_cast<double>(farthest[kAlphaLane]);
    reached.free = weight < kUnit ? 1 - weight / kUnit : 0;
  } else {
    double free = kUnit;
    for (std::size_t l = reached.first; l <= reached.last && free > 0; ++l) {
      const std::int64_t* sums = layers[l] + at;
      if (sums[kWeightLane] == 0) continue;
      const double weight = static_cast<double>(sums[kWeightLane]);
      const double taken = weight < free ? weight : free;
      const double share = taken / weight;
      for (int c = 0; c < 3; ++c) colour[c] += static_cast<double>(sums[c]) * share;
      if constexpr (lanes == kAlphaLanes) colour[3] += static_cast<double>(sums[kAlphaLane]) * share;
      free -= taken;
    }
    if (free > 0) {
      const double share = free / static_cast<double>(farthest[kWeightLane]);
      for (int c = 0; c < 3; ++c) colour[c] += static_cast<double>(farthest[c]) * share;
      if constexpr (lanes == kAlphaLanes) colour[3] += static_cast<double>(farthest[kAlphaLane]) * share;
    }
    reached.free = free / kUnit;
    scale = 1.0 / kUnit;
  }
  for (int c = 0; c < 4; ++c) out[c] = static_cast<float>(colour[c] * scale);
  if constexpr (lanes == kOpaqueLanes) out[3] = 1.f;
  return reached;
}

// What the backdrop is to know of pixel i, `colour` being what it was given.
template <int lanes>
HWY_INLINE void Look(const std::int64_t* const* layers, std::size_t count, std::size_t near, std::size_t at,
                     const Reached& reached, const float* colour, int i, Backdrop::Chunk& chunk) {
  if (reached.first >= near || reached.first > reached.last) return;
  if (reached.last < near) {
    const double amount = std::min(reached.free, 2 * (reached.free - Backdrop::kLeastFree));
    if (!(amount > 0)) return;
    chunk.holes |= std::uint32_t{1} << i;
    chunk.amount[i] = static_cast<float>(amount);
    std::copy_n(colour, 4, chunk.colour[i]);
    return;
  }
  double behind = 0;
  for (std::size_t l = near; l < count; ++l) behind += static_cast<double>(layers[l][at + kWeightLane]);
  if (behind < Backdrop::kEnoughBehind * kUnit) return;
  chunk.shows |= std::uint32_t{1} << i;
  Combine<lanes>(layers + near, count - near, at, chunk.colour[i]);
}

// n <= kChunk pixels of layers that all have sums there, the first `near` of them in front of focus; these only where
// `chunk` is not null. Returns false if a pixel had no weight.
template <SampleType type, int lanes>
bool ResolveChunk(const Accumulator* const* layers, std::size_t count, std::size_t near, int n, void* pixels,
                  Backdrop::Chunk* chunk) {
  const std::int64_t* sums[kMostLayers];
  for (std::size_t l = 0; l < count; ++l) sums[l] = reinterpret_cast<const std::int64_t*>(layers[l]);
  float colours[4 * kChunk] = {};
  bool all = true;
  for (int i = 0; i < n; ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * lanes;
    const Reached reached = Combine<lanes>(sums, count, at, colours + 4 * i);
    all &= reached.first <= reached.last;
    if (chunk != nullptr) Look<lanes>(sums, count, near, at, reached, colours + 4 * i, i, *chunk);
  }
  Store(colours, n, static_cast<Pixel<type>*>(pixels));
  return all;
}

bool ResolveLayers(const Accumulator* const* layers, std::size_t count, std::size_t near, int lanes, int n,
                   SampleType type, void* pixels, Backdrop::Chunk* chunk) {
  if (type == SampleType::half) {
    return lanes == kOpaqueLanes ? ResolveChunk<SampleType::half, kOpaqueLanes>(layers, count, near, n, pixels, chunk)
                                 : ResolveChunk<SampleType::half, kAlphaLanes>(layers, count, near, n, pixels, chunk);
  }
  return lanes == kOpaqueLanes ? ResolveChunk<SampleType::float32, kOpaqueLanes>(layers, count, near, n, pixels, chunk)
                               : ResolveChunk<SampleType::float32, kAlphaLanes>(layers, count, near, n, pixels, chunk);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(ResolveSpan);
HWY_EXPORT(ResolveLayers);

namespace {

// A pixel without weight takes its own colour.
void take_own(const ColourImage& own, int x, int y, ColourImage& out) noexcept {
  for (int c = 0; c < 4; ++c) {
    const float value = own.get(x, y, c);
    out.set(x, y, c, out.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
  }
}

bool has_weight(const Accumulator* values, int lanes, int n) noexcept {
  Accumulator any = 0;
  for (int i = 0; i < n; ++i) any |= values[i * lanes + kWeightLane];
  return any != 0;
}

}  // namespace

void resolve_span(const Accumulator* values, int lanes, int x0, int x1, int y, const ColourImage& own,
                  ColourImage& out) noexcept {
  const int x = out.window().x0 + x0, row = out.window().y0 + y;
  if (HWY_DYNAMIC_DISPATCH(ResolveSpan)(values, lanes, x1 - x0, out.type(), out.pixel(x, row))) return;
  for (int i = 0; i < x1 - x0; ++i, values += lanes) {
    if (values[kWeightLane] == 0) take_own(own, x + i, row, out);
  }
}

namespace {

// Whether a layer in front of focus that is alone covers all pixels that it reaches.
bool covers(const Accumulator* values, int lanes, int n) noexcept {
  constexpr auto enough = static_cast<Accumulator>((1 - Backdrop::kLeastFree) * static_cast<double>(kCoveringWeight));
  Accumulator least = std::numeric_limits<Accumulator>::max();
  for (int i = 0; i < n; ++i) least = std::min(least, values[i * lanes + kWeightLane] - 1);  // 0 becomes the largest
  return least >= enough;
}

}  // namespace

void resolve_layers(std::span<const Accumulator* const> layers, int lanes, int x0, int x1, int y,
                    const ColourImage& own, ColourImage& out, std::size_t near, Backdrop* backdrop) {
  constexpr int chunk_width = Backdrop::kChunk;  // pixels that are looked at together
  for (int x = x0; x < x1; x += chunk_width) {
    const int n = std::min(chunk_width, x1 - x);
    const Accumulator* present[kMostLayers];
    std::size_t count = 0, in_front = 0;
    for (std::size_t l = 0; l < layers.size(); ++l) {
      if (layers[l] == nullptr) continue;
      const Accumulator* values = layers[l] + static_cast<std::ptrdiff_t>(x - x0) * lanes;
      if (layers.size() > 1 && !has_weight(values, lanes, n)) continue;
      present[count++] = values;
      in_front += l < near;
    }
    const bool looks = backdrop != nullptr && in_front > 0 && !(count == 1 && covers(present[0], lanes, n));
    if (backdrop != nullptr && !looks) backdrop->take_none(x, y);
    if (count == 1 && !looks) {
      resolve_span(present[0], lanes, x, x + n, y, own, out);
      continue;
    }
    const int column = out.window().x0 + x, row = out.window().y0 + y;
    Backdrop::Chunk chunk;
    const bool all = count > 0 && HWY_DYNAMIC_DISPATCH(ResolveLayers)(present, count, in_front, lanes, n, out.type(),
                                                                      out.pixel(column, row), looks ? &chunk : nullptr);
    if (looks) backdrop->take(x, y, chunk);
    if (all) continue;
    for (int i = 0; i < n; ++i) {
      Accumulator any = 0;
      for (std::size_t l = 0; l < count; ++l) any |= present[l][i * lanes + kWeightLane];
      if (any == 0) take_own(own, column + i, row, out);
    }
  }
}

void resolve_rows(std::span<const LayerRow> rows, int lanes, int y, const ColourImage& own, ColourImage& out, int near,
                  Backdrop* backdrop) {
  const Accumulator* layers[kMostLayers];
  std::size_t in_front = 0;
  for (std::size_t l = 0; l < rows.size(); ++l) {
    layers[l] = rows[l].values;
    in_front += rows[l].layer < near;
  }
  resolve_layers({layers, rows.size()}, lanes, 0, out.window().width(), y, own, out, in_front, backdrop);
}

}  // namespace pullfocus
#endif
