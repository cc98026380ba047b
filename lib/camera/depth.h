// What the numbers in a depth channel mean, and which of them mean "no surface".
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

namespace pullfocus {

enum class DepthKind {
  planar,  // distance along the camera's axis, in scene units, > 0
  coc      // signed circle-of-confusion diameter in pixels, > 0 behind focus
};

std::string_view name(DepthKind kind) noexcept;          // as --depth-kind spells it
DepthKind parse_depth_kind(std::string_view text);       // throws Error(usage) naming --depth-kind
inline constexpr float planar_background_from = 1.0e9f;  // renderers write 1e10 and more where they hit nothing

// True where a pixel shows no surface. A planar background lies at infinity. A background of kind coc has
// diameter 0: such an image tells no diameter at infinity (that takes a lens), and an empty pixel must not
// smear over others.
inline bool is_background(DepthKind kind, float depth) noexcept {
  if (kind == DepthKind::coc) return !std::isfinite(depth);
  return !(depth > 0.0f && depth < planar_background_from);
}

// The value to fill pixels with that a file says nothing about: background in every kind, and never suspect.
inline float background_depth(DepthKind) noexcept { return std::numeric_limits<float>::infinity(); }

// True where a background value is no legal way of saying "empty", so that it is to be counted as repaired:
// NaN, -inf and negative planar depths always, a planar 0 where there is something to see (alpha_positive).
inline bool is_suspect(DepthKind kind, float depth, bool alpha_positive) noexcept {
  if (std::isnan(depth)) return true;
  if (kind == DepthKind::coc) return std::isinf(depth) && depth < 0.0f;
  return depth < 0.0f || (depth == 0.0f && alpha_positive);
}

}  // namespace pullfocus
