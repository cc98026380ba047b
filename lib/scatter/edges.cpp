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

// Writes the members' change of contribution at every step of the kernel: step after step, width * lanes values, zero
// where no member is.
template <int lanes, int width, bool with_minus>
HWY_INLINE void StepValues(const Kernel& kernel, const Emission<lanes>* sources, std::uint32_t members, int first_x,
                           Accumulator* HWY_RESTRICT out) {
  Accumulator at_level[256 * lanes];
  std::fill_n(at_level, lanes, Accumulator{0});
  const std::size_t level_count = kernel.levels.size();
  if (std::popcount(members) < width) {
    std::fill_n(out, kernel.steps.size() * static_cast<std::size_t>(width * lanes), Accumulator{0});
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
      values += width * lanes;
    }
  }
}

template <int lanes, int width>
HWY_INLINE void WriteEdges(const Kernel& kernel, int x, int y, const Accumulator* HWY_RESTRICT steps,
                           const BandImage& image, Band& band) {
  constexpr int n = width * lanes;
  const int from = std::max(y - kernel.radius_y, image.y0), to = std::min(y + kernel.radius_y + 1, image.y1);
  for (int row = from; row < to; ++row) {
    Accumulator* const at_source = band.row(image.band_row(row)) + static_cast<std::ptrdiff_t>(x) * lanes;
    for (const KernelEdge& edge : kernel.row((row - y) * image.direction)) {
      Accumulator* const out = at_source + static_cast<std::ptrdiff_t>(edge.dx) * lanes;
      const Accumulator* const in = steps + edge.step * n;
      if (edge.rising) {
        ForEachPart<n>([&](auto d, int i)
                           HWY_ATTR { hn::StoreU(hn::Add(hn::LoadU(d, out + i), hn::LoadU(d, in + i)), d, out + i); });
      } else {
        ForEachPart<n>([&](auto d, int i)
                           HWY_ATTR { hn::StoreU(hn::Sub(hn::LoadU(d, out + i), hn::LoadU(d, in + i)), d, out + i); });
      }
    }
  }
}

template <int lanes, int width, bool with_minus>
void Write(const Kernel& kernel, const Emission<lanes>* sources, std::uint32_t members, int x, int y,
           const BandImage& image, Band& band) {
  alignas(64) Accumulator steps[kMaxKernelSteps * width * lanes];
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
