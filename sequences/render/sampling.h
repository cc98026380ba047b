// Sample points of a pixel.
//
// Sobol's four-dimensional sequence, scrambled after B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4),
// 2020. On the lens, the first 2^k points fall one each into all elementary intervals of area 2^-k; any prefix is
// stratified, and errors shrink faster than those of independent samples. Points depend on (index, seed) alone, never
// on threads or order.
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

// Initial direction numbers of dimensions 2 to 4 (S. Joe and F. Kuo, 2008): degree and inner coefficients of the
// primitive polynomial, and m_1, m_2, ...
struct Dimension {
  std::uint32_t degree, coefficients;
  std::array<std::uint32_t, 3> first;
};
inline constexpr Dimension dimensions[] = {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}};

constexpr std::array<std::uint32_t, 32> directions(const Dimension& d) noexcept {
  std::array<std::uint32_t, 32> v{};
  for (std::uint32_t i = 0; i < 32; ++i) {
    if (i < d.degree) {
      v[i] = d.first[i] << (31 - i);
      continue;
    }
    v[i] = v[i - d.degree] ^ (v[i - d.degree] >> d.degree);
    for (std::uint32_t k = 1; k < d.degree; ++k)
      if ((d.coefficients >> (d.degree - 1 - k)) & 1u) v[i] ^= v[i - k];
  }
  return v;
}

constexpr std::uint32_t sobol(std::uint32_t index, const std::array<std::uint32_t, 32>& v) noexcept {
  std::uint32_t x = 0;
  for (std::size_t i = 0; index != 0; index >>= 1, ++i)
    if (index & 1u) x ^= v[i];
  return x;
}

inline float unit_interval(std::uint32_t bits) noexcept { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace detail

// Where on the lens and where on the pixel each of a pixel's samples goes.
class SamplePattern {
 public:
  explicit SamplePattern(int samples) {  // >= 1
    const auto second = detail::directions(detail::dimensions[0]), third = detail::directions(detail::dimensions[1]),
               fourth = detail::directions(detail::dimensions[2]);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(samples); ++i)
      points_.push_back(
          {detail::reverse_bits(i), detail::sobol(i, second), detail::sobol(i, third), detail::sobol(i, fourth)});
  }
  std::size_t size() const noexcept { return points_.size(); }

  // Both in [0,1)^2; scrambled anew for every seed.
  glm::vec2 lens(std::size_t index, std::uint32_t seed) const noexcept { return point(index, 0, seed); }
  glm::vec2 pixel(std::size_t index, std::uint32_t seed) const noexcept { return point(index, 2, seed); }

 private:
  glm::vec2 point(std::size_t index, std::uint32_t first, std::uint32_t seed) const noexcept {
    const auto scrambled = [&](std::uint32_t dimension) {
      return detail::unit_interval(
          detail::owen_scramble(points_[index][dimension], hash(seed + 0x9e3779b9u * dimension)));
    };
    return {scrambled(first), scrambled(first + 1)};
  }

  std::vector<std::array<std::uint32_t, 4>> points_;
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
