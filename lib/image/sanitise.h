// Colours that a filter may take: finite and within a largest magnitude.
#pragma once

#include <Imath/half.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "image/sample.h"

namespace pullfocus {

// Storage of one RGBA pixel, by sample type.
template <SampleType type>
struct Pixel;

template <>
struct Pixel<SampleType::half> {
  std::uint16_t rgba[4];
  bool operator==(const Pixel&) const = default;
};

template <>
struct Pixel<SampleType::float32> {
  std::uint32_t rgba[4];  // the bits of floats, so that comparing is comparing bits
  bool operator==(const Pixel&) const = default;
};

// Calls body.operator()<type>() for the run-time type.
template <typename Body>
decltype(auto) dispatch(SampleType type, Body&& body) {
  if (type == SampleType::half) return body.template operator()<SampleType::half>();
  return body.template operator()<SampleType::float32>();
}

struct ColourRepairs {
  std::int64_t not_finite = 0;  // pixels with a NaN or infinite sample: the sample counts as 0
  std::int64_t clamped = 0;     // pixels with a sample beyond the largest radiance
};

// NaN and infinities count as 0; magnitudes are clamped to max_radiance, up to 65504 rounded down to a half,
// so that a colour means the same stored as half and as float.
class Sanitiser {
 public:
  explicit Sanitiser(float max_radiance) noexcept {
    half_max_ = max_radiance >= 65504.f ? std::uint16_t{0x7bff} : imath_float_to_half(max_radiance);
    if (finite_half_to_float(half_max_) > max_radiance) --half_max_;
    float_max_ = std::bit_cast<std::uint32_t>(max_radiance > 65504.f ? max_radiance : finite_half_to_float(half_max_));
  }

  // Works on magnitudes as integers, which order as the floats do; beyond infinity lie the NaNs.
  template <SampleType type>
  Pixel<type> operator()(Pixel<type> pixel, ColourRepairs& repairs) const noexcept {
    using Bits = std::remove_reference_t<decltype(pixel.rgba[0])>;
    constexpr Bits sign = static_cast<Bits>(Bits{1} << (8 * sizeof(Bits) - 1));
    constexpr Bits infinity = type == SampleType::half ? Bits{0x7c00} : static_cast<Bits>(0x7f800000u);
    const Bits one = type == SampleType::half ? Bits{0x3c00} : static_cast<Bits>(0x3f800000u);
    const Bits limit = type == SampleType::half ? half_max_ : static_cast<Bits>(float_max_);
    bool not_finite = false, clamped = false;
    for (int c = 0; c < 4; ++c) {
      Bits& sample = pixel.rgba[c];
      const Bits largest = c == 3 && limit < one ? one : limit;
      const Bits magnitude = sample & static_cast<Bits>(~sign);
      if (magnitude <= largest) continue;
      if (magnitude >= infinity) {
        sample = 0;
        not_finite = true;
      } else {
        sample = static_cast<Bits>((sample & sign) | largest);
        clamped = true;
      }
    }
    repairs.not_finite += not_finite;
    repairs.clamped += clamped;
    return pixel;
  }

  // Bits of the largest magnitude that passes, alpha's apart, which may always be up to 1.
  template <SampleType type>
  auto limit() const noexcept {
    if constexpr (type == SampleType::half) {
      return half_max_;
    } else {
      return float_max_;
    }
  }

  template <SampleType type>
  Pixel<type> operator()(const Pixel<type>& pixel) const noexcept {
    ColourRepairs ignored;
    return (*this)(pixel, ignored);
  }

 private:
  std::uint16_t half_max_ = 0;
  std::uint32_t float_max_ = 0;
};

template <SampleType type>
Pixel<type> load_pixel(const std::byte* address) noexcept {
  Pixel<type> pixel;
  std::memcpy(&pixel, address, sizeof pixel);
  return pixel;
}

// The value of a finite sample.
inline float sample_value(std::uint16_t bits) noexcept { return finite_half_to_float(bits); }
inline float sample_value(std::uint32_t bits) noexcept { return std::bit_cast<float>(bits); }

}  // namespace pullfocus
