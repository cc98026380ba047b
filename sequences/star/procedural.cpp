#include "star/procedural.h"

#include <algorithm>
#include <cmath>

namespace pullfocus::sequences {

float hash(int x, int y, std::uint32_t seed) noexcept {
  // Odd multipliers spread the coordinates; shifts and multiplications in turn mix every bit into every
  // other.
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u;
  h ^= seed * 0xc2b2ae3du;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  h = (h ^ h >> 12) * 0x297a2d39u;
  h ^= h >> 15;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

float noise(glm::vec2 p, std::uint32_t seed) noexcept {
  const float floor_x = std::floor(p.x), floor_y = std::floor(p.y);
  const int x = static_cast<int>(floor_x), y = static_cast<int>(floor_y);
  const float u = p.x - floor_x, v = p.y - floor_y;
  const float su = u * u * (3 - 2 * u), sv = v * v * (3 - 2 * v);
  const float low = hash(x, y, seed) * (1 - su) + hash(x + 1, y, seed) * su;
  const float high = hash(x, y + 1, seed) * (1 - su) + hash(x + 1, y + 1, seed) * su;
  return low * (1 - sv) + high * sv;
}

float fractal_noise(glm::vec2 p, std::uint32_t seed) noexcept {
  return (4 * noise(p, seed) + 2 * noise(p * 2.1f, seed + 1) + noise(p * 4.3f, seed + 2)) / 7;
}

float ramp(float from, float to, float x) noexcept {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace pullfocus::sequences
