#include "importance/gain_row.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "importance/order.h"
#include "scatter/state.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "importance/gain_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A pixel is judged as part of a block if its kernels cover so many pixels: the steps between blocks are blurred then.
constexpr float kLeastArea = 8;

template <class D>
struct Channels {
  hn::Vec<D> of[3];
};

template <class D>
HWY_INLINE Channels<D> LoadChannels(D d, const Pixel<SampleType::half>* pixels) {
  const hn::Rebind<std::uint16_t, D> bits;
  const hn::Rebind<hwy::float16_t, D> half;
  hn::Vec<decltype(bits)> r, g, b, a;
  hn::LoadInterleaved4(bits, reinterpret_cast<const std::uint16_t*>(pixels), r, g, b, a);
  return {{hn::PromoteTo(d, hn::BitCast(half, r)), hn::PromoteTo(d, hn::BitCast(half, g)),
           hn::PromoteTo(d, hn::BitCast(half, b))}};
}
template <class D>
HWY_INLINE Channels<D> LoadChannels(D d, const Pixel<SampleType::float32>* pixels) {
  Channels<D> c;
  hn::Vec<D> a;
  hn::LoadInterleaved4(d, reinterpret_cast<const float*>(pixels), c.of[0], c.of[1], c.of[2], a);
  return c;
}

template <SampleType type>
void ToPlanes(const Pixel<type>* pixels, int n, PlanarRow& out) {
  const hn::CappedTag<float, 16> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  Pixel<type> padded[kTileWidth];
  if (n % lanes != 0) {
    std::memset(static_cast<void*>(padded), 0, sizeof padded);
    std::copy_n(pixels, n, padded);
    pixels = padded;
  }
  for (int i = 0; i < n; i += lanes) {
    const auto c = LoadChannels(d, pixels + i);
    for (int k = 0; k < 3; ++k) hn::StoreU(c.of[k], d, out.channel[k] + i);
  }
}

void HalfToPlanes(const Pixel<SampleType::half>* pixels, int n, PlanarRow& out) { ToPlanes(pixels, n, out); }
void FloatToPlanes(const Pixel<SampleType::float32>* pixels, int n, PlanarRow& out) { ToPlanes(pixels, n, out); }

// As pullfocus::scrambled().
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Scrambled(D d, V v) {
  v = hn::Mul(hn::Xor(v, hn::ShiftRight<16>(v)), hn::Set(d, 0x7feb352du));
  v = hn::Mul(hn::Xor(v, hn::ShiftRight<15>(v)), hn::Set(d, 0x846ca68bu));
  return hn::Xor(v, hn::ShiftRight<16>(v));
}

// The same of no numbers on all targets: a unless b is larger.
template <class V>
HWY_INLINE V Larger(V a, V b) {
  return hn::IfThenElse(hn::Lt(a, b), b, a);
}

// Writes whole vectors.
std::uint64_t Gains(const GainRow& row, int n, float* out) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::RebindToUnsigned<decltype(d)> du;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const auto zero = hn::Zero(d), most = hn::Set(d, std::numeric_limits<float>::max());
  const auto held_out = hn::Set(di, std::int32_t{kHeldOut}), never = hn::Set(di, std::int32_t{kNeverCommitted});
  std::uint64_t blocks = 0;
  for (int i = 0; i < n; i += static_cast<int>(hn::Lanes(d))) {
    auto changed = zero, aa = zero, bb = zero, ab = zero;
    for (int c = 0; c < 3; ++c) {
      const auto now = hn::Load(d, row.now.channel[c] + i), then = hn::Load(d, row.then.channel[c] + i),
                 shown = hn::Load(d, row.shown.channel[c] + i);
      const auto difference = hn::Sub(now, then), a = hn::Sub(now, shown), b = hn::Sub(then, shown);
      changed = hn::Add(changed, hn::Mul(difference, difference));
      aa = hn::Add(aa, hn::Mul(a, a));
      bb = hn::Add(bb, hn::Mul(b, b));
      ab = hn::Add(ab, hn::Mul(a, b));
    }
    const auto is = hn::PromoteTo(di, hn::LoadU(d16, row.is + i)), was = hn::PromoteTo(di, hn::LoadU(d16, row.was + i));
    // A held-out pixel shows itself, as one in focus does.
    const auto now_at = hn::IfThenElseZero(hn::Gt(is, held_out), hn::Abs(is)),
               then_at = hn::IfThenElseZero(hn::Gt(was, held_out), hn::Abs(was));
    const auto area_now = hn::GatherIndex(d, row.areas, now_at), area_then = hn::GatherIndex(d, row.areas, then_at);
    const auto of_smaller = Larger(area_now, area_then);  // 1 / A
    const auto of_colour = hn::Mul(changed, hn::Sqrt(hn::Sqrt(of_smaller)));
    const auto of_kernel =
        hn::Sub(hn::Add(hn::Mul(aa, area_now), hn::Mul(bb, area_then)),
                hn::Mul(hn::Add(ab, ab), hn::IfThenElse(hn::Lt(area_then, area_now), area_then, area_now)));
    const auto same_kernel = hn::RebindMask(d, hn::Eq(was, is));
    const auto only_kernel = hn::Not(hn::Or(same_kernel, hn::Gt(changed, zero)));
    const auto as_block = hn::And(only_kernel, hn::Le(hn::Mul(of_smaller, hn::Set(d, kLeastArea)), hn::Set(d, 1.f)));
    const auto position = hn::Add(hn::Set(du, row.first), hn::Iota(du, static_cast<std::uint32_t>(i)));
    const auto fraction =
        hn::Mul(hn::Set(d, 0x1p-24f), hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(Scrambled(du, position)))));
    const auto at_random = hn::IfThenElse(as_block, hn::LoadU(d, row.of_block + i), fraction);
    const auto of_move = hn::IfThenElse(only_kernel, hn::Mul(of_kernel, at_random), Larger(of_kernel, of_colour));
    auto gain = hn::IfThenElse(same_kernel, of_colour, of_move);
    gain = hn::IfThenElse(hn::Le(gain, most), Larger(gain, zero), most);  // also where it is no number: huge colours
    gain = hn::IfThenElse(hn::RebindMask(d, hn::Eq(was, never)), hn::Set(d, kFirstOfAll), gain);
    hn::StoreU(gain, d, out + i);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, as_block, bits);
    blocks |= static_cast<std::uint64_t>(bits[0] | bits[1] << 8) << i;
  }
  return blocks;
}

int GainLanes() { return static_cast<int>(hn::Lanes(hn::CappedTag<float, 16>())); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(HalfToPlanes);
HWY_EXPORT(FloatToPlanes);
HWY_EXPORT(Gains);
HWY_EXPORT(GainLanes);

void to_planes(const Pixel<SampleType::half>* pixels, int n, PlanarRow& out) noexcept {
  HWY_DYNAMIC_DISPATCH(HalfToPlanes)(pixels, n, out);
}
void to_planes(const Pixel<SampleType::float32>* pixels, int n, PlanarRow& out) noexcept {
  HWY_DYNAMIC_DISPATCH(FloatToPlanes)(pixels, n, out);
}

std::uint64_t gains(const GainRow& row, int n, float* out) noexcept {
  if (n % HWY_DYNAMIC_DISPATCH(GainLanes)() == 0) return HWY_DYNAMIC_DISPATCH(Gains)(row, n, out);
  float whole[kTileWidth];
  const std::uint64_t blocks = HWY_DYNAMIC_DISPATCH(Gains)(row, n, whole);
  std::copy_n(whole, n, out);
  return blocks & first_pixels(n);
}

}  // namespace pullfocus
#endif
