#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

#include "star/parts.h"
#include "star/procedural.h"

namespace pullfocus::sequences {
namespace {

constexpr float cord_half_width = 0.1f;
constexpr float knot_y = 0.23f;

constexpr glm::vec3 strands[] = {{0.46f, 0.03f, 0.035f}, {0.52f, 0.36f, 0.19f}, {0.30f, 0.015f, 0.03f}};

float axis_x(float y) { return 0.05f * y + 0.015f * std::sin(6.0f * y); }

// 0 away from the knot, 1 at its middle.
float knot_share(float y) { return 1 - ramp(0.03f, 0.085f, std::abs(y - knot_y)); }

// Nearest at the top of the picture, so that 20 mm is the least depth of the whole scene.
float depth_mm(float y) { return 22.0f - 2.0f * ramp(-0.5f, 0.5f, y); }

}  // namespace

std::optional<Surface> cord(glm::vec2 p) {
  const float knot = knot_share(p.y);
  const float across = (p.x - axis_x(p.y)) / (cord_half_width * (1 + 0.35f * knot));
  if (std::abs(across) >= 1) return std::nullopt;

  // Strands climb to the right, and to the left where they are wound around the knot.
  const float round = std::asin(across);
  const float along = knot > 0 ? 26.0f * (p.y - knot_y) - 0.25f * round : 8.5f * p.y + 0.55f * round;
  const float strand = std::floor(along);
  const float bulge = std::sin(glm::pi<float>() * (along - strand));
  const int colour = (static_cast<int>(strand) % 3 + 3) % 3;
  const float fibre = 0.7f + 0.6f * noise({along * 9.0f + 3.0f * round, round * 3.0f - along}, 31u);
  const float lit = 0.25f + 0.75f * glm::clamp(std::cos(round + 0.5f), 0.0f, 1.0f);
  const float shade = lit * (0.25f + 0.75f * bulge) * fibre;
  return Surface{strands[knot > 0 ? 1 - colour % 2 : colour] * shade, depth_mm(p.y)};
}

}  // namespace pullfocus::sequences
