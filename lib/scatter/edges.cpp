#include "scatter/edges.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "scatter/value_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Value rows lie one after the other, `kPad` zeros before, between and after them.
constexpr int kPad = 16;
static_assert(kPad >= (kMaxChain - 1) * kAlphaLanes);
template <int lanes, int width>
constexpr int kStride = width * lanes + kPad;

// Neighbouring columns from `x` on whose members share a plan; the others are written as zeros.
struct Group {
  const double *plus, *minus;  // of column x
  std::uint32_t members;
  int x, y;
};

// `row_step`: accumulators from a kernel row to the next; `first_row` is at the source's column, in row dy0.
struct Place {
  Accumulator* first_row;
  std::ptrdiff_t row_step;
  int dy0, dy1;
};

template <int lanes, int width, int length, bool rising>
HWY_INLINE void WriteChains(const EdgePlan& plan, const Accumulator* HWY_RESTRICT values, const Place& place) {
  constexpr int n = width * lanes;
  for (const EdgeChain& chain : plan.rows(rising, length, place.dy0, place.dy1)) {
    Accumulator* const out = place.first_row + (chain.dy - place.dy0) * place.row_step + chain.dx * lanes;
    const Accumulator* in[length];
    for (int k = 0; k < length; ++k) in[k] = values + chain.rows[k] * kStride<lanes, width> - k * lanes;
    ForEachPart<n + (length - 1) * lanes>([&](auto d, int i) HWY_ATTR {
      constexpr int size = static_cast<int>(hn::MaxLanes(d));
      auto v = hn::LoadU(d, out + i);
      for (int k = 0; k < length; ++k) {
        if (i + size <= k * lanes || i >= n + k * lanes) continue;
        const auto edge = hn::LoadU(d, in[k] + i);
        v = rising ? hn::Add(v, edge) : hn::Sub(v, edge);
      }
      hn::StoreU(v, d, out + i);
    });
  }
}

template <int lanes, int width, int length = 1>
HWY_INLINE void WriteLists(const EdgePlan& plan, const Accumulator* HWY_RESTRICT values, const Place& place) {
  if constexpr (length <= kMaxChain) {
    WriteChains<lanes, width, length, true>(plan, values, place);
    WriteChains<lanes, width, length, false>(plan, values, place);
    WriteLists<lanes, width, length + 1>(plan, values, place);
  }
}

// One copy for all kinds of rows.
template <int lanes, int width>
HWY_NOINLINE void WriteAllLists(const EdgePlan& plan, const Accumulator* HWY_RESTRICT values, const Place& place) {
  WriteLists<lanes, width>(plan, values, place);
}

// Where the group's kernel rows lie: in the band as they do in the kernel, since it is the source that is mirrored.
// Empty where none does.
HWY_INLINE Place PlaceOf(const Group& group, int radius_y, int lanes, const BandImage& image, Band& band) {
  const int y = group.y;
  const int from = std::max(y - radius_y, image.y0), to = std::min(y + radius_y + 1, image.y1);
  if (from >= to) return {nullptr, 0, 0, 0};
  const bool up = image.direction > 0;
  return {band.row(image.band_row(up ? from : to - 1)) + static_cast<std::ptrdiff_t>(group.x) * lanes, band.stride(),
          up ? from - y : y + 1 - to, up ? to - y : y + 1 - from};
}

template <int lanes, int width, RowKind kind>
void WriteGroup(const EdgePlan& plan, const Group& group, const BandImage& image, Band& band) {
  const Place place = PlaceOf(group, plan.radius_y, lanes, image, band);
  if (place.first_row == nullptr) return;
  alignas(64) Accumulator memory[kPad + kMostValueRows * kStride<lanes, width>];
  Accumulator* const values = memory + kPad;
  ValueRows<lanes, width, kind, kStride<lanes, width>, kPad>(plan, group.plus, group.minus, group.members, values);
  WriteAllLists<lanes, width>(plan, values, place);
}

template <int lanes, int columns>
HWY_INLINE void WritePairs(const EdgePairs& pairs, const Accumulator* HWY_RESTRICT of_kind, const Place& place) {
  for (const EdgePair& pair : pairs.rows(columns, place.dy0, place.dy1)) {
    Accumulator* const out = place.first_row + (pair.dy - place.dy0) * place.row_step + pair.dx * lanes;
    const Accumulator* const in = of_kind + pair.kind * 2 * lanes;
    ForEachPart<columns * lanes>(
        [&](auto d, int i) HWY_ATTR { hn::StoreU(hn::Add(hn::LoadU(d, out + i), hn::LoadU(d, in + i)), d, out + i); });
  }
}

template <int lanes, RowKind kind>
void WriteSingle(const EdgePlan& plan, const Group& group, const BandImage& image, Band& band) {
  const Place place = PlaceOf(group, plan.radius_y, lanes, image, band);
  if (place.first_row == nullptr) return;
  constexpr int n = 2 * lanes;
  alignas(64) Accumulator of_level[EdgePairs::kMostLevels * lanes], of_kind[EdgePairs::kMostKinds * n];
  Accumulator* level = of_level;
  ForEachPart<lanes>([&](auto d, int i) HWY_ATTR { hn::StoreU(hn::Zero(d), d, level + i); });
  for (const double weight : plan.weights) {
    level += lanes;
    ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
      const hn::Repartition<double, decltype(d)> df;
      const auto value = Contribution<kind == RowKind::recoloured>(df, group.plus + i, group.minus + i, weight);
      hn::StoreU(value, d, level + i);
    });
  }
  Accumulator* values = of_kind;
  for (const LevelPair& pair : plan.pairs.kinds) {
    ForEachPart<lanes>([&](auto d, int i) HWY_ATTR {
      const auto first = hn::LoadU(d, of_level + pair.first * lanes + i);
      hn::StoreU(hn::Sub(first, hn::LoadU(d, of_level + pair.before * lanes + i)), d, values + i);
      hn::StoreU(hn::Sub(hn::LoadU(d, of_level + pair.second * lanes + i), first), d, values + lanes + i);
    });
    values += n;
  }
  WritePairs<lanes, 1>(plan.pairs, of_kind, place);
  WritePairs<lanes, 2>(plan.pairs, of_kind, place);
}

template <int lanes, RowKind kind>
HWY_INLINE void WriteGroupOf(int width, const EdgePlan& plan, const Group& group, const BandImage& image, Band& band) {
  if (width == 1 && kind != RowKind::moved && !plan.pairs.empty()) {
    WriteSingle<lanes, kind>(plan, group, image, band);
  } else if (width == 1) {
    WriteGroup<lanes, 1, kind>(plan, group, image, band);
  } else if (width == 2) {
    WriteGroup<lanes, 2, kind>(plan, group, image, band);
  } else if (width <= 4) {
    WriteGroup<lanes, 4, kind>(plan, group, image, band);
  } else {
    WriteGroup<lanes, kWindow, kind>(plan, group, image, band);
  }
}

template <int lanes, RowKind kind>
void WriteRowOf(const KernelTable& kernels, const SourceRow<lanes>& row, int y, const BandImage& image, Band& band) {
  for (std::uint64_t pending = row.mask; pending != 0;) {
    const int first = std::countr_zero(pending);
    std::uint32_t members = Like(row.index + first, row.index[first]) & static_cast<std::uint32_t>(pending >> first);
    if constexpr (kind == RowKind::moved) members &= Like(row.old + first, row.old[first]);
    int width = std::bit_width(members);
    // Columns of other kernels in between are written as zeros: that is cheaper than splitting the group, unless there
    // are more of them than members.
    if (width > 2 * std::popcount(members)) width = static_cast<int>(members = 1);
    pending &= ~(std::uint64_t{members} << first);
    const Group group{row.plus + first * lanes, row.minus + first * lanes, members, row.x + first, y};
    if constexpr (kind == RowKind::moved) {
      for (const EdgePlan& plan : kernels.move(row.old[first], row.index[first])) {
        WriteGroupOf<lanes, kind>(width, plan, group, image, band);
      }
    } else {
      WriteGroupOf<lanes, kind>(width, kernels.plan(row.index[first]), group, image, band);
    }
  }
}

template <int lanes>
WriteRow<lanes> Writer(RowKind kind) {
  switch (kind) {
    case RowKind::recoloured:
      return WriteRowOf<lanes, RowKind::recoloured>;
    case RowKind::moved:
      return WriteRowOf<lanes, RowKind::moved>;
    case RowKind::plain:
      break;
  }
  return WriteRowOf<lanes, RowKind::plain>;
}

WriteRow<kOpaqueLanes> OpaqueWriter(RowKind kind) { return Writer<kOpaqueLanes>(kind); }
WriteRow<kAlphaLanes> AlphaWriter(RowKind kind) { return Writer<kAlphaLanes>(kind); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(OpaqueWriter);
HWY_EXPORT(AlphaWriter);

template <int lanes>
WriteRow<lanes> row_writer(RowKind kind) noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    return HWY_DYNAMIC_DISPATCH(OpaqueWriter)(kind);
  } else {
    return HWY_DYNAMIC_DISPATCH(AlphaWriter)(kind);
  }
}
template WriteRow<kOpaqueLanes> row_writer(RowKind) noexcept;
template WriteRow<kAlphaLanes> row_writer(RowKind) noexcept;

}  // namespace pullfocus
#endif
