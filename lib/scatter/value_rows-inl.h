// The value rows of a plan for neighbouring sources. Included once per SIMD target (see Highway's foreach_target.h).
#if defined(PULLFOCUS_SCATTER_VALUE_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PULLFOCUS_SCATTER_VALUE_ROWS_INL_H_
#undef PULLFOCUS_SCATTER_VALUE_ROWS_INL_H_
#else
#define PULLFOCUS_SCATTER_VALUE_ROWS_INL_H_
#endif

#include <algorithm>

#include "scatter/edge_plan.h"
#include "scatter/lanes-inl.h"
#include "scatter/source_row.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Bit i: index[i] == like, of kWindow values.
HWY_INLINE std::uint32_t Like(const std::int16_t* index, std::int16_t like) {
  const hn::CappedTag<std::int16_t, kWindow> d;
  std::uint32_t all = 0;
  for (int i = 0; i < kWindow; i += static_cast<int>(hn::Lanes(d))) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, index + i), hn::Set(d, like)), bits);
    all |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return all;
}

// At every value of a row: the bit of the column it belongs to.
template <int lanes, int width>
struct ColumnBits {
  alignas(64) std::uint64_t of[width * lanes] = {};
  constexpr ColumnBits() {
    for (int i = 0; i < width * lanes; ++i) of[i] = std::uint64_t{1} << (i / lanes);
  }
};
template <int lanes, int width>
inline constexpr ColumnBits<lanes, width> kColumnBits;

// Zero where no member is.
template <int lanes, int width>
HWY_INLINE const double* Values(const double* values, std::uint32_t members, double* HWY_RESTRICT out) {
  if (members == (1u << width) - 1) return values;
  ForEachPart<width * lanes>([&](auto d, int i) HWY_ATTR {
    const hn::Repartition<double, decltype(d)> df;
    const auto is_member = hn::TestBit(hn::Set(d, members), hn::LoadU(d, kColumnBits<lanes, width>.of + i));
    hn::StoreU(hn::IfThenElseZero(hn::RebindMask(df, is_member), hn::LoadU(df, values + i)), df, out + i);
  });
  return out;
}

// Writes the plan's value rows for the sources `members` of `width` columns, width * lanes values each, `stride` apart.
// pad > 0: and so many zeros before, between and after them.
template <int lanes, int width, RowKind kind, int stride, int pad>
HWY_INLINE void ValueRows(const EdgePlan& plan, const double* all_plus, const double* all_minus, std::uint32_t members,
                          Accumulator* HWY_RESTRICT out) {
  constexpr int n = width * lanes;
  alignas(64) double plus_of_members[n], minus_of_members[n];
  const double* const plus = Values<lanes, width>(all_plus, members, plus_of_members);
  const double* const minus =
      kind == RowKind::plain ? nullptr : Values<lanes, width>(all_minus, members, minus_of_members);
  Accumulator* values = out;
  const auto next_row = [&](auto value) HWY_ATTR {
    if constexpr (pad > 0) std::fill_n(values - pad, pad, Accumulator{0});
    ForEachPart<n>([&](auto d, int i) HWY_ATTR { hn::StoreU(value(d, i), d, values + i); });
    values += stride;
  };
  for (std::size_t k = 0; k < plan.of_plus; ++k) {
    const double weight = plan.weights[k];
    next_row([&](auto d, int i) HWY_ATTR {
      return Contribution<kind == RowKind::recoloured>(hn::Repartition<double, decltype(d)>(), plus + i, minus + i,
                                                       weight);
    });
  }
  if constexpr (kind == RowKind::moved) {
    for (std::size_t k = plan.of_plus; k < plan.weights.size(); ++k) {
      const double weight = plan.weights[k];
      next_row([&](auto d, int i) HWY_ATTR {
        return hn::Sub(hn::Zero(d),
                       Contribution<false>(hn::Repartition<double, decltype(d)>(), minus + i, nullptr, weight));
      });
    }
  }
  for (const RowPair& pair : plan.differences) {
    const Accumulator *const a = out + pair.a * stride, *const b = out + pair.b * stride;
    next_row([&](auto d, int i) HWY_ATTR { return hn::Sub(hn::LoadU(d, a + i), hn::LoadU(d, b + i)); });
  }
  for (const RowPair& pair : plan.sums) {
    const Accumulator *const a = out + pair.a * stride, *const b = out + pair.b * stride;
    next_row([&](auto d, int i) HWY_ATTR { return hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i)); });
  }
  if (plan.has_zeros) next_row([](auto d, int) HWY_ATTR { return hn::Zero(d); });
  if constexpr (pad > 0) std::fill_n(values - pad, pad, Accumulator{0});
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
