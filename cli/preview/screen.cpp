#include "preview/screen.h"

#include <tbb/parallel_for.h>

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

#include "image/sanitise.h"
#include "image/srgb.h"

namespace pullfocus::cli::preview {

namespace {

std::uint32_t packed(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  return std::uint32_t{r} | std::uint32_t{g} << 8 | std::uint32_t{b} << 16 | 0xff000000u;
}

std::uint8_t byte(float value) {  // of 0..1; NaN is 0
  return static_cast<std::uint8_t>(value > 0 ? std::min(value, 1.f) * 255 + 0.5f : 0);
}

void size_for(const Window& w, Picture& out) {
  out.width = w.width();
  out.height = w.height();
  out.rgba.resize(w.pixels());
}

// visit(x, y) gives the pixel at window coordinates; columns left of `end`, counted from the window's corner.
template <typename PixelAt>
void fill(const Window& w, int end, Picture& out, PixelAt&& pixel_at) {
  tbb::parallel_for(0, w.height(), [&](int row) {
    std::uint32_t* to = &out.rgba[static_cast<std::size_t>(row) * static_cast<std::size_t>(out.width)];
    for (int x = 0; x < end; ++x) to[x] = pixel_at(w.x0 + x, w.y0 + row);
  });
}

float luminance(const ColourImage& colour, int x, int y) {
  return 0.2126f * colour.get(x, y, 0) + 0.7152f * colour.get(x, y, 1) + 0.0722f * colour.get(x, y, 2);
}

}  // namespace

ToneTable::ToneTable(float exposure, bool srgb) : exposure_(exposure), srgb_(srgb), of_half_(1 << 16) {
  const float factor = std::exp2(exposure);
  tbb::parallel_for(0, 1 << 16, [&](int bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const bool finite = (half & 0x7c00u) != 0x7c00u;
    const float value = finite ? finite_half_to_float(half) * factor : half == 0x7c00u ? 1.f : 0.f;
    const float cut = value > 0 ? std::min(value, 1.f) : 0.f;
    of_half_[half] = byte(srgb ? srgb_encoded(cut) : cut);
  });
}

std::uint8_t ToneTable::operator()(float value) const noexcept { return of_half_[imath_float_to_half(value)]; }

void show_colour_left_of(int end, const ColourImage& colour, const ToneTable& tone, Picture& out) {
  dispatch(colour.type(), [&]<SampleType type>() {
    fill(colour.window(), end, out, [&](int x, int y) {
      const auto pixel = load_pixel<type>(colour.pixel(x, y));
      if constexpr (type == SampleType::half) {
        return packed(tone(pixel.rgba[0]), tone(pixel.rgba[1]), tone(pixel.rgba[2]));
      } else {
        return packed(tone(sample_value(pixel.rgba[0])), tone(sample_value(pixel.rgba[1])),
                      tone(sample_value(pixel.rgba[2])));
      }
    });
  });
}

void show_colour(const ColourImage& colour, const ToneTable& tone, Picture& out) {
  size_for(colour.window(), out);
  show_colour_left_of(out.width, colour, tone, out);
}

DepthRange depth_range(const Frame& frame) {
  const Window& w = frame.window();
  std::vector<float> depths;
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(w.pixels()) / 1e5)));
  for (int y = w.y0; y < w.y1; y += step) {
    for (int x = w.x0; x < w.x1; x += step) {
      const float depth = frame.depth.at(x, y);
      if (!is_background(DepthKind::planar, depth)) depths.push_back(depth);
    }
  }
  if (depths.empty()) return {};
  const auto at = [&](double share) {
    const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(depths.size() - 1));
    std::nth_element(depths.begin(), depths.begin() + n, depths.end());
    return depths[static_cast<std::size_t>(n)];
  };
  return {at(0.01), at(0.99)};
}

void show_depth(const Frame& frame, DepthKind kind, Picture& out) {
  if (kind == DepthKind::coc) {
    const CocFunction coc{DepthKind::coc, 1, 0};
    return show_coc(frame, &coc, 40, out);
  }
  size_for(frame.window(), out);
  const DepthRange range = depth_range(frame);
  const float far = range.far > 0 ? 1 / range.far : 0, near = range.near > 0 ? 1 / range.near : 0;
  const float scale = near > far ? 0.85f / (near - far) : 0;
  fill(frame.window(), out.width, out, [&](int x, int y) {
    const float depth = frame.depth.at(x, y);
    if (is_background(kind, depth)) return packed(0, 0, 0);
    const std::uint8_t grey = byte(std::clamp(0.15f + (1 / depth - far) * scale, 0.1f, 1.f));
    return packed(grey, grey, grey);
  });
}

void show_coc(const Frame& frame, const CocFunction* coc, double full_px, Picture& out) {
  size_for(frame.window(), out);
  const ToneTable tone;
  fill(frame.window(), out.width, out, [&](int x, int y) {
    const float shade = 0.35f + 0.65f * static_cast<float>(tone(luminance(frame.colour, x, y))) / 255;
    if (coc == nullptr) return packed(byte(shade), byte(shade), byte(shade));
    const float depth = frame.depth.at(x, y);
    const float c = is_background(coc->kind, depth) ? coc->background() : (*coc)(depth);
    const float size = std::abs(c);
    if (size <= 1) return packed(byte(0.25f * shade), byte(shade), byte(0.25f * shade));
    const float colour = std::sqrt(std::min(1.f, size / static_cast<float>(full_px)));
    const std::uint8_t rest = byte(shade * (0.75f - 0.65f * colour)), full = byte(shade);
    return c < 0 ? packed(full, rest, rest) : packed(rest, rest, full);
  });
}

void show_importance(const Plane& importance, Picture& out) {
  const Window& w = importance.window();
  size_for(w, out);
  float largest = 0;
  for (int y = w.y0; y < w.y1; ++y) {
    const float* row = importance.row(y);
    for (int x = 0; x < w.width(); ++x) {
      if (std::isfinite(row[x])) largest = std::max(largest, row[x]);
    }
  }
  const float scale = largest > 0 ? 1 / largest : 1;
  fill(w, out.width, out, [&](int x, int y) {
    const float value = importance.at(x, y);
    if (!(value > 0)) return packed(0, 0, 0);
    const float octaves = std::log2(std::min(value * scale, 1.f));
    const float t = std::clamp(1 + octaves / 16, 0.05f, 1.f);
    return packed(byte(std::min(1.f, 0.3f + 1.2f * t)), byte(1.6f * t - 0.6f),
                  byte(t < 0.4f ? 0.6f * (1 - t) : 3 * t - 2));
  });
}

void show_difference(const ColourImage& a, const ColourImage& b, const ToneTable& tone, Picture& out) {
  size_for(a.window(), out);
  fill(a.window(), out.width, out, [&](int x, int y) {
    std::uint8_t channel[3];
    for (int c = 0; c < 3; ++c) channel[c] = tone(std::abs(a.get(x, y, c) - b.get(x, y, c)));
    return packed(channel[0], channel[1], channel[2]);
  });
}

}  // namespace pullfocus::cli::preview
