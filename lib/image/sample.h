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

}  // namespace pullfocus
