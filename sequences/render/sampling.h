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
#include <vector>

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
  x ^= x >> 16;
  x ^= (x & 0xff00ff00u) >> 8;
  x ^= (x & 0xf0f0f0f0u) >> 4;
  x ^= (x & 0xccccccccu) >> 2;
  return x ^ ((x & 0xaaaaaaaau) >> 1);
}

inline float unit_interval(std::uint32_t bits) noexcept { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace detail

// Where on the pixel and where on the lens each of a pixel's samples goes.
class SamplePattern {
 public:
  explicit SamplePattern(int samples);  // >= 1

  struct Point {
    glm::vec2 pixel, lens;  // both in [0,1)^2
  };
  // Sample `index` of the pixel with this seed: the same pattern for all, shifted in its digits by the seed, which
  // keeps it stratified.
  Point at(std::size_t index, std::uint32_t seed) const noexcept {
    const std::array<std::uint32_t, 4>& p = points_[index];
    const auto shifted = [&](std::size_t i) {
      return detail::unit_interval(p[i] ^ hash(seed + 0x9e3779b9u * static_cast<std::uint32_t>(i)));
    };
    return {{shifted(0), shifted(1)}, {shifted(2), shifted(3)}};
  }
  std::size_t size() const noexcept { return points_.size(); }

 private:
  std::vector<std::array<std::uint32_t, 4>> points_;
};

inline SamplePattern::SamplePattern(int samples) {
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(samples); ++i) {
    const auto pair = [&](std::uint32_t seed) -> std::array<std::uint32_t, 2> {
      const std::uint32_t k = detail::owen_scramble(i, hash(seed));  // pairs the two at random
      return {detail::owen_scramble(detail::reverse_bits(k), hash(seed, 1)),
              detail::owen_scramble(detail::sobol_second(k), hash(seed, 2))};
    };
    const auto pixel = pair(11), lens = pair(23);
    points_.push_back({pixel[0], pixel[1], lens[0], lens[1]});
  }
}

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
