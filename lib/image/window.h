// Half-open pixel rectangles: [x0, x1) x [y0, y1), y downwards, as in OpenEXR but with exclusive ends.
#pragma once

#include <algorithm>
#include <cstddef>

namespace pullfocus {

struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const noexcept { return x1 - x0; }
  int height() const noexcept { return y1 - y0; }
  bool empty() const noexcept { return x1 <= x0 || y1 <= y0; }
  std::size_t pixels() const noexcept {
    return empty() ? 0 : static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  bool contains(int x, int y) const noexcept { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  bool operator==(const Window&) const = default;
};

inline Window intersect(const Window& a, const Window& b) noexcept {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// The smallest window that holds both; an empty one adds nothing.
inline Window unite(const Window& a, const Window& b) noexcept {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

inline Window grow(const Window& w, int dx, int dy) noexcept { return {w.x0 - dx, w.y0 - dy, w.x1 + dx, w.y1 + dy}; }

}  // namespace pullfocus
