#include "importance/gain.h"

#include <algorithm>

namespace pullfocus {

Gain::Gain(const Pending& pending, const ColourMetric& metric) : pending_(pending), metric_(metric) {
  for (int index = 0; index < pending.kernels.coc().size(); ++index) {
    areas_.push_back(static_cast<float>(1 / pending.kernels.area(index)));
  }
}

template <SampleType type>
void Gain::load(const Pixel<type>* pixels, int n, PlanarRow& out) const noexcept {
  to_planes(pixels, n, out);
  if (metric_.distance() == ColourDistance::rgb) return;
  for (int i = 0; i < n; ++i) {
    const auto colour = metric_({static_cast<double>(out.channel[0][i]), static_cast<double>(out.channel[1][i]),
                                 static_cast<double>(out.channel[2][i])});
    for (std::size_t c = 0; c < 3; ++c) out.channel[c][i] = static_cast<float>(colour[c]);
  }
}

template <SampleType type>
void Gain::load_rows(int x, int y, int n, PlanarRow& now, PlanarRow& then) const noexcept {
  const Window& w = pending_.frame.window();
  const auto* in = reinterpret_cast<const Pixel<type>*>(pending_.frame.colour.pixel(w.x0 + x, w.y0 + y));
  const auto* old = reinterpret_cast<const Pixel<type>*>(pending_.state.colour.pixel(w.x0 + x, w.y0 + y));
  if (all_sane<type>(pending_.sanitiser, in, n)) {
    load(in, n, now);
  } else {
    Pixel<type> sane[kTileWidth];
    for (int i = 0; i < n; ++i) sane[i] = pending_.sanitiser(in[i]);
    load(sane, n, now);
  }
  load(old, n, then);
}

std::uint64_t Gain::row(int x, int y, int n, float* out) const noexcept {
  const Window& w = pending_.frame.window();
  const std::size_t first =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(w.width()) + static_cast<std::size_t>(x);
  GainRow row;
  dispatch(pending_.frame.colour.type(), [&]<SampleType type>() { load_rows<type>(x, y, n, row.now, row.then); });
  const std::byte* result = pending_.shown.pixel(w.x0 + x, w.y0 + y);
  dispatch(pending_.shown.type(),
           [&]<SampleType type>() { load(reinterpret_cast<const Pixel<type>*>(result), n, row.shown); });
  const auto copy = [&](const std::int16_t* from, std::int16_t* to) {
    std::copy_n(from, n, to);
    std::fill(to + n, to + kTileWidth, std::int16_t{0});
  };
  copy(&pending_.index[first], row.is);
  copy(&pending_.state.index[first], row.was);

  const auto position = [&](int column, int line) {  // another one in every call
    return static_cast<std::uint32_t>(line) * static_cast<std::uint32_t>(w.width()) +
           static_cast<std::uint32_t>(column) + 0x9e3779b9u * pending_.round;
  };
  row.first = position(x, y);
  for (int i = 0; i < kTileWidth;) {
    const int column = (x + i) / kBlockWidth * kBlockWidth;  // tiles begin at multiples of it
    const float of_block = fraction_of(scrambled(position(column, y / kBlockHeight * kBlockHeight)));
    for (; i < kTileWidth && x + i < column + kBlockWidth; ++i) row.of_block[i] = of_block;
  }
  row.areas = areas_.data();
  return gains(row, n, out);
}

}  // namespace pullfocus
