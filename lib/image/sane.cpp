#include "image/sane.h"

#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/sane.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// True if no |sample| exceeds the limit; magnitudes order as integers do.
template <class T>
HWY_INLINE bool Within(const T* samples, int n, T limit) {
  const hn::ScalableTag<T> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  constexpr T without_sign = std::numeric_limits<T>::max();
  const auto most = hn::Set(d, limit), mask = hn::Set(d, without_sign);
  auto largest = hn::Zero(d);
  int i = 0;
  for (; i + lanes <= n; i += lanes) largest = hn::Max(largest, hn::And(hn::LoadU(d, samples + i), mask));
  bool within = hn::AllFalse(d, hn::Gt(largest, most));
  for (; i < n; ++i) within &= static_cast<T>(samples[i] & without_sign) <= limit;
  return within;
}

bool WithinHalf(const std::int16_t* samples, int n, std::int16_t limit) { return Within(samples, n, limit); }
bool WithinFloat(const std::int32_t* samples, int n, std::int32_t limit) { return Within(samples, n, limit); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(WithinHalf);
HWY_EXPORT(WithinFloat);

template <SampleType type>
bool all_sane(const Sanitiser& sanitiser, const Pixel<type>* pixels, int n) noexcept {
  if constexpr (type == SampleType::half) {
    return HWY_DYNAMIC_DISPATCH(WithinHalf)(reinterpret_cast<const std::int16_t*>(pixels), 4 * n,
                                            static_cast<std::int16_t>(sanitiser.limit<type>()));
  } else {
    return HWY_DYNAMIC_DISPATCH(WithinFloat)(reinterpret_cast<const std::int32_t*>(pixels), 4 * n,
                                             static_cast<std::int32_t>(sanitiser.limit<type>()));
  }
}

template bool all_sane(const Sanitiser&, const Pixel<SampleType::half>*, int) noexcept;
template bool all_sane(const Sanitiser&, const Pixel<SampleType::float32>*, int) noexcept;

}  // namespace pullfocus
#endif
