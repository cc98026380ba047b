#include "scatter/source_row.h"

#include <algorithm>
#include <cstring>

#include "image/sane.h"
#include "scatter/index_row.h"
#include "simd/prefetch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/source_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE hn::Vec<D> LoadValues(D d, const Pixel<SampleType::half>& pixel, int c) {
  const hn::Rebind<float, D> df;
  const hn::Rebind<hwy::float16_t, D> d16;
  return hn::PromoteTo(d, hn::PromoteTo(df, hn::LoadU(d16, reinterpret_cast<const hwy::float16_t*>(pixel.rgba) + c)));
}
template <class D>
HWY_INLINE hn::Vec<D> LoadValues(D d, const Pixel<SampleType::float32>& pixel, int c) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), reinterpret_cast<const float*>(pixel.rgba) + c));
}

// As many pixels as fill whole vectors to opaque lanes, times `sign`. Returns how many.
template <SampleType type>
HWY_INLINE int WholeVectors(const Pixel<type>* pixels, int n, double sign, double* HWY_RESTRICT out) {
  const hn::CappedTag<double, 8> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  constexpr int together = static_cast<int>(hn::MaxLanes(d)) / kOpaqueLanes;  // pixels
  int i = 0;
  if constexpr (together > 0) {
    const auto factor = hn::Set(d, sign);
    const auto lane = hn::And(hn::Iota(du, 0), hn::Set(du, std::uint64_t{kOpaqueLanes - 1}));
    const auto is_weight = hn::RebindMask(d, hn::Eq(lane, hn::Set(du, std::uint64_t{kWeightLane})));
    for (; i + together <= n; i += together) {
      const auto colour = hn::Mul(LoadValues(d, pixels[i], 0), factor);
      hn::StoreU(hn::IfThenElse(is_weight, factor, colour), d, out + i * kOpaqueLanes);
    }
  }
  return i;
}

// n pixels to lanes, times `sign`.
template <int lanes, SampleType type>
void Lanes(const Pixel<type>* pixels, int n, double sign, double* HWY_RESTRICT out) {
  const hn::CappedTag<double, 4> d;
  constexpr int step = static_cast<int>(hn::MaxLanes(d));
  const auto factor = hn::Set(d, sign);
  int i = 0;
  if constexpr (lanes == kOpaqueLanes) i = WholeVectors(pixels, n, sign, out);
  for (out += i * lanes; i < n; ++i, out += lanes) {
    for (int c = 0; c < 4; c += step) hn::StoreU(hn::Mul(LoadValues(d, pixels[i], c), factor), d, out + c);
    if constexpr (lanes == kAlphaLanes) out[kAlphaLane] = out[kWeightLane];
    out[kWeightLane] = sign;
  }
}

// Bit i of kTileWidth: whether is(d, i) holds for value i, asked of vectors of values.
template <class Is>
HWY_INLINE std::uint64_t BitsOfRow(Is&& is) {
  const hn::CappedTag<std::int16_t, 32> d;
  std::uint64_t bits = 0;
  for (int i = 0; i < kTileWidth; i += static_cast<int>(hn::Lanes(d))) {
    std::uint8_t stored[8] = {};
    hn::StoreMaskBits(d, is(d, i), stored);
    std::uint64_t part = 0;
    std::memcpy(&part, stored, sizeof part);
    bits |= part << i;
  }
  return bits;
}

// Bit i: a[i] == b[i], of kTileWidth values.
std::uint64_t Equal(const std::int16_t* a, const std::int16_t* b) {
  return BitsOfRow([&](auto d, int i) HWY_ATTR { return hn::Eq(hn::LoadU(d, a + i), hn::LoadU(d, b + i)); });
}

// Bit i: |a[i] - b[i]| <= most, of kTileWidth values.
std::uint64_t Near(const std::int16_t* a, const std::int16_t* b, std::int16_t most) {
  return BitsOfRow([&](auto d, int i) HWY_ATTR {
    const auto v = hn::SaturatedSub(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), high = hn::Set(d, most);
    return hn::Not(hn::Or(hn::Lt(v, hn::Neg(high)), hn::Gt(v, high)));
  });
}

void OpaqueHalf(const Pixel<SampleType::half>* pixels, int n, double sign, double* out) {
  Lanes<kOpaqueLanes>(pixels, n, sign, out);
}
void OpaqueFloat(const Pixel<SampleType::float32>* pixels, int n, double sign, double* out) {
  Lanes<kOpaqueLanes>(pixels, n, sign, out);
}
void AlphaHalf(const Pixel<SampleType::half>* pixels, int n, double sign, double* out) {
  Lanes<kAlphaLanes>(pixels, n, sign, out);
}
void AlphaFloat(const Pixel<SampleType::float32>* pixels, int n, double sign, double* out) {
  Lanes<kAlphaLanes>(pixels, n, sign, out);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

namespace {

HWY_EXPORT(Equal);
HWY_EXPORT(Near);
HWY_EXPORT(OpaqueHalf);
HWY_EXPORT(OpaqueFloat);
HWY_EXPORT(AlphaHalf);
HWY_EXPORT(AlphaFloat);

template <int lanes>
void to_lanes(const Pixel<SampleType::half>* pixels, int n, double sign, double* out) noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    HWY_DYNAMIC_DISPATCH(OpaqueHalf)(pixels, n, sign, out);
  } else {
    HWY_DYNAMIC_DISPATCH(AlphaHalf)(pixels, n, sign, out);
  }
}
template <int lanes>
void to_lanes(const Pixel<SampleType::float32>* pixels, int n, double sign, double* out) noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    HWY_DYNAMIC_DISPATCH(OpaqueFloat)(pixels, n, sign, out);
  } else {
    HWY_DYNAMIC_DISPATCH(AlphaFloat)(pixels, n, sign, out);
  }
}

constexpr int kPiece = 8;  // columns that are converted together

// Calls convert(first, n) for pieces of the row that hold set bits; `columns` of the tile lie in the image.
template <typename Convert>
void for_pieces(std::uint64_t mask, int columns, Convert&& convert) {
  for (int i = 0; mask != 0;) {
    const int skipped = std::countr_zero(mask) / kPiece * kPiece;
    i += skipped;
    mask >>= skipped;
    int n = 0;
    while (n < kTileWidth && (mask & 0xff) != 0) {
      mask >>= kPiece;
      n += kPiece;
    }
    convert(i, std::min(n, columns - i));
    i += n;
  }
}

template <int lanes, SampleType type>
void load_plain(const Pixel<type>* pixels, std::uint64_t mask, int columns, double sign, double* out) noexcept {
  for_pieces(mask, columns, [&](int i, int n) { to_lanes<lanes>(pixels + i, n, sign, out + i * lanes); });
}

template <int lanes, SampleType type>
void load_sane(const Pixel<type>* pixels, const Sanitiser& sanitiser, std::uint64_t mask, int columns,
               double* out) noexcept {
  for_pieces(mask, columns, [&](int i, int n) {
    if (all_sane<type>(sanitiser, pixels + i, n)) return to_lanes<lanes>(pixels + i, n, 1, out + i * lanes);
    Pixel<type> sane[kTileWidth];
    for (int k = 0; k < n; ++k) sane[k] = sanitiser(pixels[i + k]);
    to_lanes<lanes>(sane, n, 1, out + i * lanes);
  });
}

void load_indices(const std::int16_t* from, int n, std::int16_t* out) noexcept {
  std::copy_n(from, n, out);
  std::fill(out + n, out + SourceRow<kOpaqueLanes>::kColumns, kNeverCommitted);
}

// Of a row of indices: those that count.
std::uint64_t counted(const std::int16_t* index, const Sources& sources) noexcept {
  const std::uint64_t all = within(index, sources.range.first, sources.range.last);
  if (sources.least == 0) return all;
  const auto most = static_cast<std::int16_t>(sources.least - 1);
  return all & ~within(index, static_cast<std::int16_t>(-most), most);
}

template <int lanes, SampleType type>
void collect_typed(const Sources& sources, int x, int y, std::uint64_t mask, RowSources<lanes>& row) noexcept {
  const Window& w = sources.state->colour.window();
  const auto offset = static_cast<std::size_t>(y) * static_cast<std::size_t>(w.width()) + static_cast<std::size_t>(x);
  const int columns = std::min(kTileWidth, w.width() - x);
  const auto* old_colours = reinterpret_cast<const Pixel<type>*>(sources.state->colour.pixel(w.x0 + x, w.y0 + y));
  const std::int16_t* old_index = sources.state->index.data() + offset;
  row.added.x = row.taken_back.x = row.recoloured.x = row.moved.x = x;
  row.taken_back.mask = row.recoloured.mask = row.moved.mask = 0;
  if (sources.frame == nullptr) {
    load_indices(old_index, columns, row.added.index);
    row.added.mask = mask & counted(row.added.index, sources);
    load_plain<lanes>(old_colours, row.added.mask, columns, 1, row.added.plus);
    return;
  }
  const auto* colours = reinterpret_cast<const Pixel<type>*>(sources.frame->colour.pixel(w.x0 + x, w.y0 + y));
  load_indices(sources.pending + offset, columns, row.added.index);
  load_indices(old_index, columns, row.taken_back.index);
  const std::int16_t *const is = row.added.index, *const was = row.taken_back.index;
  const std::uint64_t now = mask & counted(is, sources), then = mask & counted(was, sources);
  const std::uint64_t same = HWY_DYNAMIC_DISPATCH(Equal)(is, was);
  const std::uint64_t near = HWY_DYNAMIC_DISPATCH(Near)(is, was, KernelTable::kFarthestMove);
  const auto load_both = [&](SourceRow<lanes>& both) {
    std::copy_n(is, SourceRow<lanes>::kColumns, both.index);
    load_sane<lanes>(colours, *sources.sanitiser, both.mask, columns, both.plus);
    load_plain<lanes>(old_colours, both.mask, columns, 1, both.minus);
  };
  row.recoloured.mask = now & same;
  if (row.recoloured.mask != 0) load_both(row.recoloured);
  row.moved.mask = now & then & near & ~same;
  if (row.moved.mask != 0) {
    load_both(row.moved);
    std::copy_n(was, SourceRow<lanes>::kColumns, row.moved.old);
  }
  row.added.mask = now & ~same & ~row.moved.mask;
  row.taken_back.mask = then & ~same & ~row.moved.mask;
  load_sane<lanes>(colours, *sources.sanitiser, row.added.mask, columns, row.added.plus);
  load_plain<lanes>(old_colours, row.taken_back.mask, columns, -1, row.taken_back.plus);
}

}  // namespace

void fetch_ahead(const Sources& sources, int x, int y) noexcept {
  const Window& w = sources.state->colour.window();
  const auto offset = static_cast<std::size_t>(y) * static_cast<std::size_t>(w.width()) + static_cast<std::size_t>(x);
  const auto fetch = [&](const ColourImage& colours, const std::int16_t* indices) {
    prefetch(colours.pixel(w.x0 + x, w.y0 + y), kTileWidth * colours.pixel_bytes(), kCacheLine);
    prefetch(indices + offset, kTileWidth * sizeof *indices, kCacheLine);
  };
  fetch(sources.state->colour, sources.state->index.data());
  if (sources.frame != nullptr) fetch(sources.frame->colour, sources.pending);
}

template <int lanes>
void collect(const Sources& sources, int x, int y, std::uint64_t mask, RowSources<lanes>& row) noexcept {
  dispatch(sources.state->colour.type(),
           [&]<SampleType type>() { collect_typed<lanes, type>(sources, x, y, mask, row); });
}
template void collect(const Sources&, int, int, std::uint64_t, RowSources<kOpaqueLanes>&) noexcept;
template void collect(const Sources&, int, int, std::uint64_t, RowSources<kAlphaLanes>&) noexcept;

}  // namespace pullfocus
#endif
