#include "importance/gain.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pullfocus {

namespace {

// A pixel is judged as part of a block if its kernels cover so many pixels: the steps between blocks are blurred then.
constexpr float kLeastArea = 8;

}  // namespace

Gain::Gain(const Pending& pending, const ColourMetric& metric) : pending_(pending), metric_(metric) {
  for (int index = 0; index < pending.kernels.coc().size(); ++index) {
    const double area = pending.kernels.area(index);
    areas_.push_back(static_cast<float>(1 / area));
    fourth_roots_.push_back(static_cast<float>(1 / std::sqrt(std::sqrt(area))));
  }
}

template <SampleType type, typename PixelAt>
void Gain::load(int n, PixelAt&& pixel_at, Colours& out) const noexcept {
  for (int i = 0; i < n; ++i) {
    const Pixel<type> pixel = pixel_at(i);
    for (int c = 0; c < 3; ++c) out.channel[c][i] = sample_value(pixel.rgba[c]);
  }
  if (metric_.distance() == ColourDistance::rgb) return;
  for (int i = 0; i < n; ++i) {
    const auto colour = metric_({static_cast<double>(out.channel[0][i]), static_cast<double>(out.channel[1][i]),
                                 static_cast<double>(out.channel[2][i])});
    for (std::size_t c = 0; c < 3; ++c) out.channel[c][i] = static_cast<float>(colour[c]);
  }
}

template <SampleType type>
void Gain::load_rows(int x, int y, int n, Colours& now, Colours& then) const noexcept {
  const Window& w = pending_.frame.window();
  const auto* in = reinterpret_cast<const Pixel<type>*>(pending_.frame.colour.pixel(w.x0 + x, w.y0 + y));
  const auto* old = reinterpret_cast<const Pixel<type>*>(pending_.state.colour.pixel(w.x0 + x, w.y0 + y));
  if (all_sane<type>(pending_.sanitiser, in, n)) {
    load<type>(
        n, [&](int i) { return in[i]; }, now);
  } else {
    load<type>(
        n, [&](int i) { return pending_.sanitiser(in[i]); }, now);
  }
  load<type>(
      n, [&](int i) { return old[i]; }, then);
}

std::uint64_t Gain::row(int x, int y, int n, float* out) const noexcept {
  const Window& w = pending_.frame.window();
  const std::size_t first =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(w.width()) + static_cast<std::size_t>(x);
  const std::int16_t *const was = &pending_.state.index[first], *const is = &pending_.index[first];
  Colours now, then, shown;
  dispatch(pending_.frame.colour.type(), [&]<SampleType type>() { load_rows<type>(x, y, n, now, then); });
  const std::byte* result = pending_.shown.pixel(w.x0 + x, w.y0 + y);
  dispatch(pending_.shown.type(), [&]<SampleType type>() {
    const auto* pixels = reinterpret_cast<const Pixel<type>*>(result);
    load<type>(
        n, [&](int i) { return pixels[i]; }, shown);
  });

  // Loops without branches, which the compiler turns into vectors.
  float changed[kTileWidth] = {}, aa[kTileWidth] = {}, bb[kTileWidth] = {}, ab[kTileWidth] = {};
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < n; ++i) {
      const float d = now.channel[c][i] - then.channel[c][i];
      const float a = now.channel[c][i] - shown.channel[c][i], b = then.channel[c][i] - shown.channel[c][i];
      changed[i] += d * d;
      aa[i] += a * a;
      bb[i] += b * b;
      ab[i] += a * b;
    }
  }
  // In [0, 1), other ones in every call.
  const auto spread = [&](int column, int row) {
    const std::uint32_t at =
        static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(w.width()) + static_cast<std::uint32_t>(column);
    return 0x1p-24f * static_cast<float>(scrambled(at + 0x9e3779b9u * pending_.round) >> 8);
  };
  float of_block[kTileWidth / kBlockWidth];
  const int tile_x = x / kTileWidth * kTileWidth;
  for (int b = 0; b < kTileWidth / kBlockWidth; ++b) {
    of_block[b] = spread(tile_x + b * kBlockWidth, y / kBlockHeight * kBlockHeight);
  }
  bool as_block[kTileWidth];
  for (int i = 0; i < n; ++i) {
    // A held-out pixel shows itself, as one in focus does.
    const auto now_at = static_cast<std::size_t>(reach_index(is[i])),
               then_at = static_cast<std::size_t>(reach_index(was[i]));
    const float area_now = areas_[now_at], area_then = areas_[then_at];
    const float of_colour = changed[i] * std::max(fourth_roots_[now_at], fourth_roots_[then_at]);
    const float of_kernel = aa[i] * area_now + bb[i] * area_then - 2 * ab[i] * std::min(area_now, area_then);
    const bool only_kernel = was[i] != is[i] && !(changed[i] > 0);
    as_block[i] = only_kernel && std::max(area_now, area_then) * kLeastArea <= 1;
    const float at_random = as_block[i] ? of_block[(x + i - tile_x) / kBlockWidth] : spread(x + i, y);
    const float of_move = only_kernel ? of_kernel * at_random : std::max(of_kernel, of_colour);
    const float gain = was[i] == is[i] ? of_colour : of_move;
    constexpr float most = std::numeric_limits<float>::max();  // also where it is no number, among huge colours
    out[i] = gain <= most ? std::max(gain, 0.f) : most;
    if (was[i] == kNeverCommitted) out[i] = kFirstOfAll;
  }
  std::uint64_t blocks = 0;
  for (int i = 0; i < n; ++i) blocks |= std::uint64_t{as_block[i]} << i;
  return blocks;
}

}  // namespace pullfocus
