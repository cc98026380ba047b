// Conversions that every SIMD target must round alike. Included once per target (see Highway's foreach_target.h); knows
// nothing of images or filters.
#if defined(PULLFOCUS_SIMD_CONVERT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PULLFOCUS_SIMD_CONVERT_INL_H_
#undef PULLFOCUS_SIMD_CONVERT_INL_H_
#else
#define PULLFOCUS_SIMD_CONVERT_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The integers nearest to v, ties to even, as std::llrint gives them in the default rounding mode; |v| < 2^62.
//
// Without an instruction for it, vectors of four are split at 2^32: hi, the multiple of 2^32 nearest to v, and lo = v -
// hi, exact since its |lo| <= 2^31 needs no bit below v's last. Adding 1.5 * 2^52 rounds each to an integer, which then
// is the low end of the sum's mantissa. hi is even, so ties of lo go where those of v go.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> RoundToInt64(D d, V v) {
#if HWY_TARGET == HWY_SCALAR
  (void)d;
  return hn::Set(hn::RebindToSigned<D>(), static_cast<std::int64_t>(std::llrint(hn::GetLane(v))));
#elif HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  using Out = hn::Vec<hn::RebindToSigned<D>>;
  (void)d;
  if constexpr (sizeof(v.raw) == 64) {
    return Out{_mm512_cvtpd_epi64(v.raw)};
  } else if constexpr (sizeof(v.raw) == 32) {
    return Out{_mm256_cvtpd_epi64(v.raw)};
  } else {
    return Out{_mm_cvtpd_epi64(v.raw)};
  }
#elif HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
  (void)d;  // two at a time, converting each is faster than splitting both
  return hn::Vec<hn::RebindToSigned<D>>{
      _mm_set_epi64x(_mm_cvtsd_si64(_mm_unpackhi_pd(v.raw, v.raw)), _mm_cvtsd_si64(v.raw))};
#else
  const hn::RebindToSigned<D> di;
  const auto magic = hn::Set(d, 0x1.8p52);
  const auto high = hn::Add(hn::Mul(v, hn::Set(d, 0x1p-32)), magic);
  const auto low = hn::Add(hn::Sub(v, hn::Mul(hn::Sub(high, magic), hn::Set(d, 0x1p32))), magic);
  return hn::Add(hn::ShiftLeft<32>(hn::BitCast(di, high)),
                 hn::Sub(hn::BitCast(di, low), hn::Set(di, std::int64_t{0x4338000000000000})));
#endif
}

// Bits of the halves nearest to floats of magnitude at most 65504, ties to even.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::Rebind<std::uint16_t, D>> HalfFromFloat(D d, V v) {
  const hn::Rebind<std::uint16_t, D> d16;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  (void)d;
  return hn::BitCast(d16, hn::DemoteTo(hn::Rebind<hwy::float16_t, D>(), v));
#else
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  const auto set = [&](std::uint32_t value) HWY_ATTR { return hn::Set(du, value); };
  const auto bits = hn::BitCast(du, v);
  const auto magnitude = hn::And(bits, set(0x7fffffffu));
  // Normal halves: round away the last 13 bits and move the bias. Below 2^-14, adding 1/2 makes the float unit round to
  // the spacing of half denormals, 2^-24.
  const auto odd = hn::And(hn::ShiftRight<13>(magnitude), set(1));
  const auto normal = hn::ShiftRight<13>(hn::Sub(hn::Add(hn::Add(magnitude, set(0xfffu)), odd), set(0x38000000u)));
  const auto sum = hn::Add(hn::BitCast(d, magnitude), hn::Set(d, 0.5f));
  const auto denormal = hn::Sub(hn::BitCast(du, sum), set(0x3f000000u));
  const auto is_denormal = hn::Lt(hn::BitCast(di, magnitude), hn::Set(di, 0x38800000));
  const auto half = hn::IfThenElse(hn::RebindMask(du, is_denormal), denormal, normal);
  const auto sign = hn::And(hn::ShiftRight<16>(bits), set(0x8000u));
  // Narrowing saturates signed values; sign-extended from 16 bits they pass unharmed.
  const auto wide = hn::ShiftRight<16>(hn::BitCast(di, hn::ShiftLeft<16>(hn::Or(half, sign))));
  return hn::BitCast(d16, hn::DemoteTo(hn::Rebind<std::int16_t, D>(), wide));
#endif
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#endif
