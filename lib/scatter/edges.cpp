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

// Neighbouring columns from `x` on whose members share a kernel; the others are written as zeros.
struct Group {
  const Kernel& kernel;
  const double *plus, *minus;  // of column x
  std::uint32_t members;
  int x, y;
};

// Zero where no member is.
template <int lanes, int width>
HWY_INLINE const double* Values(const double* values, std::uint32_t members, double* HWY_RESTRICT out) {
  if (members == (1u << width) - 1) return values;
  std::fill_n(out, width * lanes, 0.0);
  for (; members != 0; members &= members - 1) {
    const int at = std::countr_zero(members) * lanes;
    ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
      const hn::Repartition<double, decltype(d)> df;
      hn::StoreU(hn::LoadU(df, values + at + i), df, out + at + i);
    });
  }
  return out;
}

// Writes the group's change of contribution at every step of the kernel: step after step, width * lanes values.
template <int lanes, int width, bool with_minus>
HWY_INLINE void StepValues(const Group& group, Accumulator* HWY_RESTRICT out) {
  constexpr int n = width * lanes, stride = kStepStride<lanes, width>;
  const Kernel& kernel = group.kernel;
  alignas(64) double plus_of_members[n], minus_of_members[n];
  const double* const plus = Values<lanes, width>(group.plus, group.members, plus_of_members);
  const double* const minus = with_minus ? Values<lanes, width>(group.minus, group.members, minus_of_members) : nullptr;
  std::fill_n(out - kPad, kPad, Accumulator{0});
  const std::size_t levels = kernel.levels.size();
  Accumulator* values = out;
  for (std::size_t k = 1; k < levels; ++k, values += stride) {
    const auto weight = static_cast<double>(kernel.levels[k]);
    ForEachPart<n>([&](auto d, int i) HWY_ATTR {
      const hn::Repartition<double, decltype(d)> df;
      hn::StoreU(Contribution<with_minus>(df, plus + i, minus + i, weight), d, values + i);
    });
    std::fill_n(values + n, kPad, Accumulator{0});
  }
  for (std::size_t s = levels - 1; s < kernel.steps.size(); ++s, values += stride) {
    const Accumulator *const high = out + (kernel.steps[s].high - 1) * stride, *const low =
                                                                                   out +
                                                                                   (kernel.steps[s].low - 1) * stride;
    ForEachPart<n>([&](auto d, int i)
                       HWY_ATTR { hn::StoreU(hn::Sub(hn::LoadU(d, high + i), hn::LoadU(d, low + i)), d, values + i); });
    std::fill_n(values + n, kPad, Accumulator{0});
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
    ForEachPart<n + (length - 1) * lanes>([&](auto d, int i) HWY_ATTR {
      constexpr int size = static_cast<int>(hn::MaxLanes(d));
      auto v = hn::LoadU(d, out + i);
      for (int k = 0; k < length; ++k) {
        if (i + size <= k * lanes || i >= n + k * lanes) continue;
        const auto step = hn::LoadU(d, in[k] + i);
        v = rising ? hn::Add(v, step) : hn::Sub(v, step);
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
HWY_INLINE void WriteEdges(const Group& group, const Accumulator* HWY_RESTRICT steps, const BandImage& image,
                           Band& band) {
  const Kernel& kernel = group.kernel;
  const int y = group.y;
  const int from = std::max(y - kernel.radius_y, image.y0), to = std::min(y + kernel.radius_y + 1, image.y1);
  if (from >= to) return;
  // Kernel rows lie in the band as they do in the kernel: it is the source that is mirrored.
  const bool up = image.direction > 0;
  const int dy0 = up ? from - y : y + 1 - to, dy1 = up ? to - y : y + 1 - from;
  Accumulator* const first_row =
      band.row(image.band_row(up ? from : to - 1)) + static_cast<std::ptrdiff_t>(group.x) * lanes;
  WriteLists<lanes, width, 1>(kernel, dy0, dy1, steps, first_row, band.stride());
}

template <int lanes, int width, bool with_minus>
void WriteGroup(const Group& group, const BandImage& image, Band& band) {
  alignas(64) Accumulator values[kPad + kMaxKernelSteps * kStepStride<lanes, width>];
  Accumulator* const steps = values + kPad;
  StepValues<lanes, width, with_minus>(group, steps);
  WriteEdges<lanes, width>(group, steps, image, band);
}

// Bit i: index[i] == index[0], of kWindow values.
HWY_INLINE std::uint32_t LikeFirst(const std::int16_t* index) {
  const hn::CappedTag<std::int16_t, kWindow> d;
  const auto first = hn::Set(d, index[0]);
  std::uint32_t like = 0;
  for (int i = 0; i < kWindow; i += static_cast<int>(hn::Lanes(d))) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, index + i), first), bits);
    like |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return like;
}

template <int lanes, bool with_minus>
void WriteRowOf(const KernelTable& kernels, const SourceRow<lanes>& row, int y, const BandImage& image, Band& band) {
  for (std::uint64_t pending = row.mask; pending != 0;) {
    const int first = std::countr_zero(pending);
    std::uint32_t members = LikeFirst(row.index + first) & static_cast<std::uint32_t>(pending >> first);
    int width = std::bit_width(members);
    // Columns of other kernels in between are written as zeros: that is cheaper than splitting the group, unless there
    // are more of them than members.
    if (width > 2 * std::popcount(members)) width = static_cast<int>(members = 1);
    pending &= ~(std::uint64_t{members} << first);
    const Group group{kernels.kernel(row.index[first]),
                      row.plus + first * lanes,
                      row.minus + first * lanes,
                      members,
                      row.x + first,
                      y};
    if (width == 1) {
      WriteGroup<lanes, 1, with_minus>(group, image, band);
    } else if (width == 2) {
      WriteGroup<lanes, 2, with_minus>(group, image, band);
    } else if (width <= 4) {
      WriteGroup<lanes, 4, with_minus>(group, image, band);
    } else {
      WriteGroup<lanes, kWindow, with_minus>(group, image, band);
    }
  }
}

WriteRow<kOpaqueLanes> OpaqueWriter(bool with_minus) {
  return with_minus ? WriteRowOf<kOpaqueLanes, true> : WriteRowOf<kOpaqueLanes, false>;
}
WriteRow<kAlphaLanes> AlphaWriter(bool with_minus) {
  return with_minus ? WriteRowOf<kAlphaLanes, true> : WriteRowOf<kAlphaLanes, false>;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(OpaqueWriter);
HWY_EXPORT(AlphaWriter);

template <int lanes>
WriteRow<lanes> row_writer(bool with_minus) noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    return HWY_DYNAMIC_DISPATCH(OpaqueWriter)(with_minus);
  } else {
    return HWY_DYNAMIC_DISPATCH(AlphaWriter)(with_minus);
  }
}
template WriteRow<kOpaqueLanes> row_writer(bool) noexcept;
template WriteRow<kAlphaLanes> row_writer(bool) noexcept;

}  // namespace pullfocus
#endif
