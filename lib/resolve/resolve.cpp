#include "resolve/resolve.h"

#include <algorithm>

#include "image/sanitise.h"

namespace pullfocus {

namespace {

void store(std::uint16_t* out, float value) noexcept {
  *out = finite_float_to_half(std::clamp(value, -65504.f, 65504.f));
}
void store(std::uint32_t* out, float value) noexcept { *out = std::bit_cast<std::uint32_t>(value); }

template <SampleType type, int lanes>
void divide(const Accumulator* values, int n, int x, int y, const ColourImage& own, Pixel<type>* out) noexcept {
  for (int i = 0; i < n; ++i, values += lanes) {
    const auto weight = static_cast<std::int64_t>(values[kWeightLane]);
    if (weight == 0) [[unlikely]] {
      for (int c = 0; c < 4; ++c) store(&out[i].rgba[c], own.get(x + i, y, c));
      continue;
    }
    const double scale = 1.0 / static_cast<double>(weight);
    for (int c = 0; c < 3; ++c) {
      const auto sum = static_cast<double>(static_cast<std::int64_t>(values[c]));
      store(&out[i].rgba[c], static_cast<float>(sum * scale));
    }
    if constexpr (lanes == kAlphaLanes) {
      const auto sum = static_cast<double>(static_cast<std::int64_t>(values[kAlphaLane]));
      store(&out[i].rgba[3], static_cast<float>(sum * scale));
    } else {
      store(&out[i].rgba[3], 1.f);
    }
  }
}

}  // namespace

void resolve_span(const Accumulator* values, int lanes, int x0, int x1, int y, const ColourImage& own,
                  ColourImage& out) noexcept {
  const Window& window = out.window();
  const int x = window.x0 + x0, row = window.y0 + y;
  dispatch(out.type(), [&]<SampleType type>() {
    auto* pixels = reinterpret_cast<Pixel<type>*>(out.pixel(x, row));
    if (lanes == kOpaqueLanes) {
      divide<type, kOpaqueLanes>(values, x1 - x0, x, row, own, pixels);
    } else {
      divide<type, kAlphaLanes>(values, x1 - x0, x, row, own, pixels);
    }
  });
}

}  // namespace pullfocus
