#include "scatter/occluded_edges.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/occluded_edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "scatter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// In front of the key, or behind it.
template <bool in_front>
HWY_INLINE std::uint64_t Hidden(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                                NearSizes near) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto limit = hn::Set(d, key), first = hn::Set(d, near.first), span = hn::Set(d, near.span);
  std::uint64_t bits = 0;
  for (int i = 0; i < n; i += lanes) {
    const auto other = hn::LoadU(d, keys + i);
    const auto ordered = in_front ? hn::Lt(other, limit) : hn::Lt(limit, other);
    const auto unlike = hn::Gt(hn::Sub(hn::LoadU(d, sizes + i), first), span);
    std::uint8_t stored[8] = {};
    hn::StoreMaskBits(d, hn::And(ordered, unlike), stored);
    std::uint64_t part = 0;
    std::memcpy(&part, stored, sizeof part);
    bits |= part << i;
  }
  return bits & (~std::uint64_t{0} >> (64 - n));
}

std::uint64_t HiddenBy(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                       NearSizes near) {
  return Hidden<true>(keys, sizes, n, key, near);
}
std::uint64_t HiddenFrom(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                         NearSizes near) {
  return Hidden<false>(keys, sizes, n, key, near);
}

// Contributions by level, negated where they are to be subtracted.
template <int lanes>
HWY_INLINE void LevelValues(const Kernel& kernel, const Emission<lanes>& source, bool negated, Accumulator* out) {
  std::fill_n(out, lanes, Accumulator{0});
  for (std::size_t k = 1; k < kernel.levels.size(); ++k) {
    ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
      const hn::Repartition<double, decltype(d)> df;
      const auto value = Contribution<false>(df, source.plus + i, nullptr, static_cast<double>(kernel.levels[k]));
      hn::StoreU(negated ? hn::Sub(hn::Zero(d), value) : value, d, out + k * lanes + i);
    });
  }
}

// Edges of a kernel row inside the runs of set bits; bit 0 is column `first`, which lies in the row.
template <int lanes>
HWY_INLINE void WriteRuns(const Kernel& kernel, std::span<const KernelEdge> edges, std::uint64_t mask, int first,
                          const Accumulator* at_level, Accumulator* at_source) {
  std::size_t e = 0;
  const auto change = [&](int dx, int from, int to) HWY_ATTR {
    Accumulator* const out = at_source + static_cast<std::ptrdiff_t>(dx) * lanes;
    ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
      const auto by = hn::Sub(hn::LoadU(d, at_level + to * lanes + i), hn::LoadU(d, at_level + from * lanes + i));
      hn::StoreU(hn::Add(hn::LoadU(d, out + i), by), d, out + i);
    });
  };
  while (mask != 0) {
    const int start = std::countr_zero(mask), length = std::countr_one(mask >> start);
    const int x0 = first + start, x1 = x0 + length;
    while (e < edges.size() && edges[e].dx <= x0) ++e;
    int level = kernel.level_behind(edges[e - 1]);
    change(x0, 0, level);
    for (; e < edges.size() && edges[e].dx < x1; ++e) {
      const int next = kernel.level_behind(edges[e]);
      change(edges[e].dx, level, next);
      level = next;
    }
    change(x1, level, 0);
    if (start + length == 64) break;
    mask &= ~std::uint64_t{0} << (start + length);
  }
}

template <int lanes>
void WriteHiddenRows(const Kernel& kernel, const Emission<lanes>& source, const HiddenSource& hidden, int y,
                     const BandImage& image, Band& band) {
  const int half = hidden.window / 2, width = hidden.planes->width();
  // Where the source is an image beside the picture, only columns of the picture count; reads stay within the margins.
  const int left = std::max(hidden.first_dx, -source.x - half);
  const int right = std::min(hidden.first_dx + hidden.window, width - source.x + half);
  const int from = std::max({y - kernel.radius_y, y - half, image.y0});
  const int to = std::min({y + kernel.radius_y + 1, y + half, image.y1});
  alignas(64) Accumulator at_level[256 * lanes];
  bool ready = false;
  for (int row = from; row < to; ++row) {
    const auto edges = kernel.row((row - y) * image.direction);
    if (edges.empty()) continue;
    const int a = std::max<int>(edges.front().dx, left), b = std::min<int>(edges.back().dx, right);
    if (a >= b) continue;
    const int band_row = image.band_row(row);
    const std::uint64_t mask =
        Hidden<true>(hidden.planes->keys(band_row) + source.x + a, hidden.planes->sizes(band_row) + source.x + a, b - a,
                     hidden.key, hidden.near);
    if (mask == 0) continue;
    if (!ready) LevelValues<lanes>(kernel, source, hidden.take_out, at_level);
    ready = true;
    WriteRuns<lanes>(kernel, edges, mask, a, at_level,
                     band.row(band_row) + static_cast<std::ptrdiff_t>(source.x) * lanes);
  }
}

WriteHidden<kOpaqueLanes> OpaqueHiddenWriter() { return WriteHiddenRows<kOpaqueLanes>; }
WriteHidden<kAlphaLanes> AlphaHiddenWriter() { return WriteHiddenRows<kAlphaLanes>; }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(HiddenBy);
HWY_EXPORT(HiddenFrom);
HWY_EXPORT(OpaqueHiddenWriter);
HWY_EXPORT(AlphaHiddenWriter);

std::uint64_t hidden_by(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                        NearSizes near) noexcept {
  return HWY_DYNAMIC_DISPATCH(HiddenBy)(keys, sizes, n, key, near);
}
std::uint64_t hidden_from(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                          NearSizes near) noexcept {
  return HWY_DYNAMIC_DISPATCH(HiddenFrom)(keys, sizes, n, key, near);
}

template <int lanes>
WriteHidden<lanes> hidden_writer() noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    return HWY_DYNAMIC_DISPATCH(OpaqueHiddenWriter)();
  } else {
    return HWY_DYNAMIC_DISPATCH(AlphaHiddenWriter)();
  }
}
template WriteHidden<kOpaqueLanes> hidden_writer() noexcept;
template WriteHidden<kAlphaLanes> hidden_writer() noexcept;

}  // namespace pullfocus
#endif
