#include "scatter/edges.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "scatter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Steps lie one after the other, `kPad` zeros before, between and after them.
constexpr int kPad = 16;
static_assert(kPad >= (kMaxChain - 1) * kAlphaLanes);
template <int lanes, int width>
constexpr int kStepStride = width * lanes + kPad;

// Writes the members' change of contribution at every step of the kernel: step after step, width * lanes values, zero
// where no member is.
template <int lanes, int width, bool with_minus>
HWY_INLINE void StepValues(const Kernel& kernel, const Emission<lanes>* sources, std::uint32_t members, int first_x,
                           Accumulator* HWY_RESTRICT out) {
  constexpr int n = width * lanes, stride = kStepStride<lanes, width>;
  Accumulator at_level[256 * lanes];
  std::fill_n(at_level, lanes, Accumulator{0});
  const std::size_t level_count = kernel.levels.size();
  if constexpr (width > 1) {
    const bool gaps = std::popcount(members) < width;
    Accumulator* pad = out - kPad;
    for (std::size_t s = 0; s <= kernel.steps.size(); ++s, pad += stride) {
      std::fill_n(pad, kPad, Accumulator{0});
      if (gaps) std::fill_n(pad + kPad, n, Accumulator{0});
    }
  }
  for (; members != 0; members &= members - 1) {
    const Emission<lanes>& source = sources[std::countr_zero(members)];
    for (std::size_t k = 1; k < level_count; ++k) {
      const auto weight = static_cast<double>(kernel.levels[k]);
      ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
        const hn::Repartition<double, decltype(d)> df;
        hn::StoreU(Contribution<with_minus>(df, source.plus + i, source.minus + i, weight), d,
                   at_level + k * lanes + i);
      });
    }
    Accumulator* values = out + (source.x - first_x) * lanes;
    for (const KernelStep& step : kernel.steps) {
      ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
        const auto high = hn::LoadU(d, at_level + step.high * lanes + i);
        hn::StoreU(hn::Sub(high, hn::LoadU(d, at_level + step.low * lanes + i)), d, values + i);
      });
      values += stride;
    }
  }
}

// Adds or subtracts `length` steps at neighbouring columns in one pass over the columns they cover: a second pass over
// columns just written would wait for the first one's stores. `row_step`: accumulators from a kernel row to the next.
template <int lanes, int width, int length, bool rising>
HWY_INLINE void WriteChains(std::span<const KernelChain> chains, int dy0, const Accumulator* HWY_RESTRICT steps,
                            Accumulator* HWY_RESTRICT first_row, std::ptrdiff_t row_step) {
  constexpr int n = width * lanes;
  for (const KernelChain& chain : chains) {
    Accumulator* const out = first_row + (chain.dy - dy0) * row_step + chain.dx * lanes;
    const Accumulator* in[length];
    for (int k = 0; k < length; ++k) in[k] = steps + chain.steps[k] * kStepStride<lanes, width> - k * lanes;
    const auto add = [&](auto d, int k, int i, auto v) HWY_ATTR {
      const auto step = hn::LoadU(d, in[k] + i);
      return rising ? hn::Add(v, step) : hn::Sub(v, step);
    };
    if constexpr (width == 1) {  // steps do not overlap
      for (int k = 0; k < length; ++k) {
        ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
          const int at = k * lanes + i;
          hn::StoreU(add(d, k, at, hn::LoadU(d, out + at)), d, out + at);
        });
      }
      continue;
    }
    ForEachPart<n + (length - 1) * lanes>([&](auto d, int i) HWY_ATTR {
      constexpr int size = static_cast<int>(hn::MaxLanes(d));
      auto v = hn::LoadU(d, out + i);
      for (int k = 0; k < length; ++k) {
        if (i + size > k * lanes && i < n + k * lanes) v = add(d, k, i, v);
      }
      hn::StoreU(v, d, out + i);
    });
  }
}

template <int lanes, int width, int length>
HWY_INLINE void WriteLists(const Kernel& kernel, int dy0, int dy1, const Accumulator* HWY_RESTRICT steps,
                           Accumulator* HWY_RESTRICT first_row, std::ptrdiff_t row_step) {
  if constexpr (length <= kMaxChain) {
    WriteChains<lanes, width, length, true>(kernel.rows(kernel.chains[true][length - 1], dy0, dy1), dy0, steps,
                                            first_row, row_step);
    WriteChains<lanes, width, length, false>(kernel.rows(kernel.chains[false][length - 1], dy0, dy1), dy0, steps,
                                             first_row, row_step);
    WriteLists<lanes, width, length + 1>(kernel, dy0, dy1, steps, first_row, row_step);
  }
}

template <int lanes, int width>
HWY_INLINE void WriteEdges(const Kernel& kernel, int x, int y, const Accumulator* HWY_RESTRICT steps,
                           const BandImage& image, Band& band) {
  const int from = std::max(y - kernel.radius_y, image.y0), to = std::min(y + kernel.radius_y + 1, image.y1);
  if (from >= to) return;
  // Kernel rows lie in the band as they do in the kernel: it is the source that is mirrored.
  const bool up = image.direction > 0;
  const int dy0 = up ? from - y : y + 1 - to, dy1 = up ? to - y : y + 1 - from;
  Accumulator* const first_row = band.row(image.band_row(up ? from : to - 1)) + static_cast<std::ptrdiff_t>(x) * lanes;
  WriteLists<lanes, width, 1>(kernel, dy0, dy1, steps, first_row, band.stride());
}

template <int lanes, int width, bool with_minus>
void Write(const Kernel& kernel, const Emission<lanes>* sources, std::uint32_t members, int x, int y,
           const BandImage& image, Band& band) {
  alignas(64) Accumulator values[kPad + kMaxKernelSteps * kStepStride<lanes, width>];
  Accumulator* const steps = values + kPad;
  StepValues<lanes, width, with_minus>(kernel, sources, members, x, steps);
  WriteEdges<lanes, width>(kernel, x, y, steps, image, band);
}

template <int lanes, bool with_minus>
constexpr GroupWriters<lanes> kWriters{{Write<lanes, 1, with_minus>, Write<lanes, 2, with_minus>,
                                        Write<lanes, 4, with_minus>, Write<lanes, kWindow, with_minus>}};

GroupWriters<kOpaqueLanes> OpaqueWriters(bool with_minus) {
  return with_minus ? kWriters<kOpaqueLanes, true> : kWriters<kOpaqueLanes, false>;
}
GroupWriters<kAlphaLanes> AlphaWriters(bool with_minus) {
  return with_minus ? kWriters<kAlphaLanes, true> : kWriters<kAlphaLanes, false>;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(OpaqueWriters);
HWY_EXPORT(AlphaWriters);

template <int lanes>
GroupWriters<lanes> group_writers(bool with_minus) noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    return HWY_DYNAMIC_DISPATCH(OpaqueWriters)(with_minus);
  } else {
    return HWY_DYNAMIC_DISPATCH(AlphaWriters)(with_minus);
  }
}
template GroupWriters<kOpaqueLanes> group_writers(bool) noexcept;
template GroupWriters<kAlphaLanes> group_writers(bool) noexcept;

}  // namespace pullfocus
#endif
