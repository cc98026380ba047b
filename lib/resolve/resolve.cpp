#include "resolve/resolve.h"

#include <algorithm>
#include <cstring>

#include "image/sanitise.h"

namespace pullfocus {

namespace {

constexpr int kChunk = 32;  // pixels divided before they are stored: storing them together vectorises

void store(const float* values, int n, std::uint16_t* out) noexcept {
  for (int i = 0; i < n; ++i) out[i] = finite_float_to_half(std::clamp(values[i], -65504.f, 65504.f));
}
void store(const float* values, int n, std::uint32_t* out) noexcept {
  std::memcpy(out, values, static_cast<std::size_t>(n) * sizeof *out);
}

// RGBA of up to kChunk pixels, the first at (x, y) of `own`.
template <int lanes>
void divide(const Accumulator* values, int n, int x, int y, const ColourImage& own, float* out) noexcept {
  for (int i = 0; i < n; ++i, values += lanes, out += 4) {
    const auto weight = static_cast<std::int64_t>(values[kWeightLane]);
    if (weight == 0) [[unlikely]] {
      for (int c = 0; c < 4; ++c) out[c] = own.get(x + i, y, c);
      continue;
    }
    const double scale = 1.0 / static_cast<double>(weight);
    const auto quotient = [&](int lane) {
      return static_cast<float>(static_cast<double>(static_cast<std::int64_t>(values[lane])) * scale);
    };
    for (int c = 0; c < 3; ++c) out[c] = quotient(c);
    out[3] = lanes == kAlphaLanes ? quotient(lanes - 1) : 1.f;
  }
}

template <SampleType type, int lanes>
void resolve(const Accumulator* values, int n, int x, int y, const ColourImage& own, Pixel<type>* out) noexcept {
  float colours[4 * kChunk];
  for (int i = 0; i < n; i += kChunk) {
    const int count = std::min(kChunk, n - i);
    divide<lanes>(values + static_cast<std::ptrdiff_t>(i) * lanes, count, x + i, y, own, colours);
    store(colours, 4 * count, out[i].rgba);
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
      resolve<type, kOpaqueLanes>(values, x1 - x0, x, row, own, pixels);
    } else {
      resolve<type, kAlphaLanes>(values, x1 - x0, x, row, own, pixels);
    }
  });
}

}  // namespace pullfocus
