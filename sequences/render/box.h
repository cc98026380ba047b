// Axis-aligned boxes in world space.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>

namespace pullfocus::sequences {

struct Box {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};

  void add(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool empty() const noexcept { return !(low.x <= high.x); }
  float diagonal() const { return empty() ? 1 : glm::length(high - low); }
  bool holds(const Box& other) const noexcept {
    return other.empty() ||
           (glm::all(glm::lessThanEqual(low, other.low)) && glm::all(glm::lessThanEqual(other.high, high)));
  }

  // A little larger, so that rounding loses no ray that meets what lies in it.
  Box with_margin() const {
    if (empty()) return *this;
    const glm::vec3 margin = 1e-4f * (high - low + glm::abs(low) + glm::abs(high));
    Box larger;
    larger.low = low - margin;
    larger.high = high + margin;
    return larger;
  }

  // Whether the ray from ray parameter 0 to `to` surely does not meet the box; `inverse`: 1 / direction, by component.
  // Comparisons with NaN (origin on the box's plane, direction along it) are false, and leave the interval as it is.
  bool missed_by(const glm::vec3& origin, const glm::vec3& inverse, float to) const noexcept {
    if (empty()) return true;
    float enter = 0, leave = to;
    for (int axis = 0; axis < 3; ++axis) {
      float first = (low[axis] - origin[axis]) * inverse[axis], last = (high[axis] - origin[axis]) * inverse[axis];
      if (inverse[axis] < 0) std::swap(first, last);
      if (first > enter) enter = first;
      if (last < leave) leave = last;
    }
    return !(enter <= leave);
  }
};

}  // namespace pullfocus::sequences
