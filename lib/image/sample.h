// Sample types of colour images.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace pullfocus {

enum class SampleType : std::uint8_t { half, float32 };

inline std::size_t sample_bytes(SampleType type) noexcept { return type == SampleType::half ? 2 : 4; }

// Exact value of a finite half given by its bits. Multiplying by 2^112 moves the exponent bias from 15 to 127
// and turns half denormals into normal floats, without a table or a branch; infinities and NaN do not
// survive.
inline float finite_half_to_float(std::uint16_t bits) noexcept {
  const std::uint32_t magnitude = static_cast<std::uint32_t>(bits & 0x7fffu) << 13;
  const float value = std::bit_cast<float>(magnitude) * 0x1p112f;
  const std::uint32_t sign = static_cast<std::uint32_t>(bits & 0x8000u) << 16;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) | sign);
}

// Bits of the half nearest to a float of magnitude at most 65504, ties to even. Branch-free, so that it vectorises.
inline std::uint16_t finite_float_to_half(float value) noexcept {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  // Normal halves: round away the last 13 bits and move the bias. Below 2^-14, adding 1/2 makes the float unit round
  // to the spacing of half denormals, 2^-24.
  const std::uint32_t normal = (magnitude + 0xfffu + ((magnitude >> 13) & 1u) - 0x38000000u) >> 13;
  const std::uint32_t denormal = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
  const std::uint32_t half = magnitude < 0x38800000u ? denormal : normal;
  return static_cast<std::uint16_t>(half | ((bits >> 16) & 0x8000u));
}

}  // namespace pullfocus
