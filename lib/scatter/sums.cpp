#include "scatter/sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/sums.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The first four lanes lie in vectors of their own, so that a column is one addition long.
template <int lanes>
HWY_INLINE void PrefixSum(Accumulator* values, int columns) {
  const hn::CappedTag<Accumulator, kOpaqueLanes> d;
  constexpr int step = static_cast<int>(hn::MaxLanes(d)), parts = kOpaqueLanes / step;
  hn::Vec<decltype(d)> sum[parts];
  for (auto& part : sum) part = hn::Zero(d);
  Accumulator last = 0;
  for (int x = 0; x < columns; ++x, values += lanes) {
    for (int k = 0; k < parts; ++k) {
      sum[k] = hn::Add(sum[k], hn::LoadU(d, values + k * step));
      hn::StoreU(sum[k], d, values + k * step);
    }
    if constexpr (lanes > kOpaqueLanes) values[kOpaqueLanes] = last += values[kOpaqueLanes];
  }
}

void PrefixSumOpaque(Accumulator* values, int columns) { PrefixSum<kOpaqueLanes>(values, columns); }
void PrefixSumAlpha(Accumulator* values, int columns) { PrefixSum<kAlphaLanes>(values, columns); }

void AddSums(const Accumulator* HWY_RESTRICT values, std::size_t n, Accumulator* HWY_RESTRICT sums) {
  const hn::ScalableTag<Accumulator> d;
  const std::size_t step = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + step <= n; i += step) hn::StoreU(hn::Add(hn::LoadU(d, sums + i), hn::LoadU(d, values + i)), d, sums + i);
  for (; i < n; ++i) sums[i] += values[i];
}

void CopySumsPastCaches(const Accumulator* HWY_RESTRICT values, std::size_t n, Accumulator* HWY_RESTRICT sums) {
  const hn::ScalableTag<Accumulator> d;
  const std::size_t step = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + step <= n; i += step) hn::Stream(hn::LoadU(d, values + i), d, sums + i);
  for (; i < n; ++i) sums[i] = values[i];
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(PrefixSumOpaque);
HWY_EXPORT(PrefixSumAlpha);
HWY_EXPORT(AddSums);
HWY_EXPORT(CopySumsPastCaches);

void prefix_sum(Accumulator* values, int columns, int lanes) noexcept {
  if (lanes == kOpaqueLanes) {
    HWY_DYNAMIC_DISPATCH(PrefixSumOpaque)(values, columns);
  } else {
    HWY_DYNAMIC_DISPATCH(PrefixSumAlpha)(values, columns);
  }
}

void copy_sums_past_caches(const Accumulator* values, std::size_t n, Accumulator* sums) noexcept {
  HWY_DYNAMIC_DISPATCH(CopySumsPastCaches)(values, n, sums);
}

void finish_copies() noexcept { hwy::FlushStream(); }

void add_sums(const Accumulator* values, std::size_t n, Accumulator* sums) noexcept {
  HWY_DYNAMIC_DISPATCH(AddSums)(values, n, sums);
}

}  // namespace pullfocus
#endif
