// Sample points of a pixel.
//
// Two-dimensional (0,2)-sequences: the first 2^k points fall one each into all elementary intervals of area 2^-k, so
// that any prefix is stratified and errors of smooth integrands shrink faster than 1/N in variance. Sobol's first two
// dimensions, scrambled after B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. Points depend on
// (index, seed) alone, never on threads or order.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

namespace pullfocus::sequences {

// A well-mixed function of its argument (C. Wellons' lowbias32).
constexpr std::uint32_t hash(std::uint32_t x) noexcept {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

constexpr std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z = 0) noexcept {
  return hash(x ^ hash((y + 0x85ebca6bu) ^ hash(z + 0x9e3779b9u)));
}

namespace detail {

constexpr std::uint32_t reverse_bits(std::uint32_t x) noexcept {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Nested uniform scrambling of the bits of x (Laine and Karras, with Burley's constants).
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) noexcept {
  x = reverse_bits(x);
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reverse_bits(x);
}

// Sobol's second dimension: Pascal's triangle modulo 2, all columns at once.
constexpr std::uint32_t sobol_second(std::uint32_t index) noexcept {
  std::uint32_t x = reverse_bits(index);
  x ^= x << 16;
  x ^= (x & 0x00ff00ffu) << 8;
  x ^= (x & 0x0f0f0f0fu) << 4;
  x ^= (x & 0x33333333u) << 2;
  return x ^ ((x & 0x55555555u) << 1);
}

inline float unit_interval(std::uint32_t bits) noexcept { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace detail

// Where on the pixel and where on the lens a pixel's samples go: two sequences of the pixel's own, paired at random.
class PixelSamples {
 public:
  explicit PixelSamples(std::uint32_t seed) noexcept {
    for (std::uint32_t i = 0; i < 6; ++i) seeds_[i] = hash(seed + 0x9e3779b9u * i);
  }
  glm::vec2 pixel(std::uint32_t index) const noexcept { return point(index, 0); }
  glm::vec2 lens(std::uint32_t index) const noexcept { return point(index, 3); }

 private:
  glm::vec2 point(std::uint32_t index, std::size_t first) const noexcept {
    const std::uint32_t shuffled = detail::owen_scramble(index, seeds_[first]);
    return {detail::unit_interval(detail::owen_scramble(detail::reverse_bits(shuffled), seeds_[first + 1])),
            detail::unit_interval(detail::owen_scramble(detail::sobol_second(shuffled), seeds_[first + 2]))};
  }

  std::array<std::uint32_t, 6> seeds_{};
};

// From the unit square to the unit disc, areas in proportion (P. Shirley and K. Chiu, "A Low Distortion Map Between
// Disk and Square", 1997).
inline glm::vec2 concentric_disc(glm::vec2 u) noexcept {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  constexpr float quarter_pi = 0.78539816f;
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = wide ? quarter_pi * (b / a) : 2 * quarter_pi - quarter_pi * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace pullfocus::sequences
