#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "star/parts.h"
#include "star/procedural.h"

namespace pullfocus::sequences {
namespace {

constexpr float cabinet_front_mm = 100.0f, cabinet_back_mm = 165.0f;
constexpr float cabinet_left = 0.17f, cabinet_right = 0.47f;  // of the front, in the picture
constexpr float cabinet_top = 0.24f, cabinet_bottom = -0.30f;
constexpr float ball_radius = 0.115f;  // in the picture
const glm::vec3 ball_light = glm::normalize(glm::vec3(0.35f, 0.8f, 0.5f));

// One of four drawers with a name card and a handle; `at` is 0..1 over the whole front.
glm::vec3 drawer_colour(glm::vec2 at) {
  const glm::vec3 metal(0.23f, 0.30f, 0.24f);
  const glm::vec2 in = glm::vec2(at.x, fraction(at.y * 4)) - 0.5f;
  const glm::vec2 off = glm::abs(in);
  if (off.x > 0.45f || off.y > 0.44f) return metal * 0.28f;
  const float from_handle = std::abs(in.y + 0.12f);
  if (off.x < 0.17f && from_handle < 0.055f) return glm::vec3(0.9f, 0.88f, 0.82f) * (1.1f - 12.0f * from_handle);
  if (off.x < 0.13f && std::abs(in.y - 0.17f) < 0.10f) {
    const bool writing = fraction(in.y * 22.0f) < 0.35f && off.x < 0.10f;
    return writing ? glm::vec3(0.10f, 0.10f, 0.16f) : glm::vec3(0.72f, 0.68f, 0.52f);
  }
  const float brushed = 0.9f + 0.2f * noise({at.x * 6.0f, at.y * 160.0f}, 51u);
  return metal * (brushed * (1.05f + 0.5f * in.y));
}

std::optional<Surface> cabinet_front(glm::vec2 p) {
  const glm::vec2 at((p.x - cabinet_left) / (cabinet_right - cabinet_left),
                     (p.y - cabinet_bottom) / (cabinet_top - cabinet_bottom));
  if (at.x < 0 || at.x > 1 || at.y < 0 || at.y > 1) return std::nullopt;
  return Surface{drawer_colour(at), cabinet_front_mm};
}

// The plane through the left edge of the front, along the camera's axis: its depth follows from the ray's x.
std::optional<Surface> cabinet_side(glm::vec2 p, float left_edge) {
  if (!(p.x > 0 && p.x < left_edge)) return std::nullopt;
  const float depth = cabinet_front_mm * left_edge / p.x;
  const float y = p.y * depth / cabinet_front_mm;
  if (depth > cabinet_back_mm || y > cabinet_top || y < cabinet_bottom) return std::nullopt;
  const float brushed = 0.85f + 0.3f * noise({depth * 0.2f, y * 120.0f}, 52u);
  return Surface{glm::vec3(0.075f, 0.10f, 0.085f) * brushed, depth};
}

std::optional<Surface> ball(glm::vec2 p) {
  static constexpr glm::vec3 panels[] = {{0.75f, 0.05f, 0.04f}, {0.80f, 0.78f, 0.72f}, {0.04f, 0.16f, 0.55f},
                                         {0.80f, 0.78f, 0.72f}, {0.85f, 0.45f, 0.03f}, {0.80f, 0.78f, 0.72f}};
  const glm::vec2 q = (p - ball_centre) / ball_radius;
  const float square = glm::dot(q, q);
  if (square >= 1) return std::nullopt;
  const glm::vec3 normal(q, std::sqrt(1 - square));
  const float turn = std::atan2(normal.x + 0.35f * normal.y, normal.z - 0.2f * normal.y) / glm::two_pi<float>();
  const glm::vec3 panel = panels[static_cast<int>(fraction(turn + 0.55f) * 12) % 6];
  const float diffuse = std::max(glm::dot(normal, ball_light), 0.0f);
  return Surface{panel * (0.07f + 0.85f * diffuse) + 1.5f * std::pow(diffuse, 60.0f),
                 ball_depth_mm * (1 - normal.z * ball_radius * mm_per_picture_unit_and_mm)};
}

}  // namespace

std::optional<Surface> furniture(const Layout& layout, glm::vec2 p) {
  const glm::vec2 shift(furniture_shift(layout), 0);
  if (const auto hit = ball(p + shift)) return hit;
  if (const auto hit = cabinet_front(p - shift)) return hit;
  return cabinet_side(p, cabinet_left + shift.x);
}

}  // namespace pullfocus::sequences
