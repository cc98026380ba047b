// Textures out of arithmetic: functions of the coordinates alone, nothing stored.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

namespace pullfocus::sequences {

// Uniform in [0, 1).
float hash(int x, int y, std::uint32_t seed) noexcept;

// Smooth noise in [0, 1], features of size 1.
float noise(glm::vec2 p, std::uint32_t seed) noexcept;

// Three octaves of noise(), in [0, 1].
float fractal_noise(glm::vec2 p, std::uint32_t seed) noexcept;

// 0 below `from`, 1 above `to`, smooth between.
float ramp(float from, float to, float x) noexcept;

inline float fraction(float x) noexcept { return x - std::floor(x); }  // in [0, 1]

}  // namespace pullfocus::sequences
