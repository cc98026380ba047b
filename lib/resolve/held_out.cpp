#include "resolve/held_out.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace pullfocus {

void show_held_out(const SourceState& state, int x0, int x1, int y, ColourImage& out) noexcept {
  if (!state.may_hold_out) return;
  const Window& w = state.colour.window();
  const std::int16_t* index = &state.index[static_cast<std::size_t>(y) * static_cast<std::size_t>(w.width())];
  for (int x = x0; x < x1; ++x) {
    if (index[x] != kHeldOut) continue;
    for (int c = 0; c < 4; ++c) {
      const float value = state.colour.get(w.x0 + x, w.y0 + y, c);
      out.set(w.x0 + x, w.y0 + y, c, out.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
    }
  }
}

void show_held_out(const SourceState& state, ColourImage& out) {
  if (!state.may_hold_out) return;
  const Window& w = state.colour.window();
  tbb::parallel_for(0, w.height(), [&](int y) { show_held_out(state, 0, w.width(), y, out); });
}

}  // namespace pullfocus
