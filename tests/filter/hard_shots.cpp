#include "hard_shots.h"

#include <cmath>
#include <limits>

#include "plain_frames.h"

namespace pullfocus::test {

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr auto half = SampleType::half;
constexpr auto float32 = SampleType::float32;
constexpr Window small{0, 0, 24, 16};
constexpr CocFunction lens{DepthKind::planar, 8, 0.5f};  // focused at 2; 4 px at infinity

// Calls colour(i) and depth(i) for every pixel i, counted row by row.
template <typename Colour, typename Depth>
void paint(Frame& frame, const Window& window, SampleType type, Colour&& colour, Depth&& depth) {
  frame.colour.reset(window, type);
  frame.depth.reset(window, 0);
  int i = 0;
  for_each_in(window, [&](int x, int y) {
    set_colour(frame.colour, x, y, colour(i));
    frame.depth.at(x, y) = depth(i);
    ++i;
  });
}

// Radiance from 2^-16 to 2^15, evenly over its logarithm.
Rgba hdr(unsigned seed, int f, int i, float alpha = 1) {
  const auto channel = [&](int c) { return std::exp2(uniform(seed, f, i, c, -16, 15)); };
  return {channel(0), channel(1), channel(2), alpha};
}

template <std::size_t n>
float one_of(const float (&values)[n], unsigned seed, int f, int i) {
  return values[static_cast<std::size_t>(uniform(seed, f, i, 9, 0, n))];
}

// F = 50 mm at f/8 on 36 mm, distances in metres.
CocFunction real_lens(LensModel model, double focus) {
  ThinLens thin{50, 8, focus};
  thin.model = model;
  return coc_function(thin, {small.width(), small.height(), 1}, DepthKind::planar);
}

void flicker(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  const auto lit = [&](int i) { return f > 0 && uniform(1, f, i, 0, 0, 1) < 1.f / 16; };
  paint(
      frame, small, float32,
      [&](int i) {
        return lit(i) ? Rgba{65504, 65504, 65504, 1} : Rgba{1e-5f, 1e-5f, 1e-5f, 1};
      },
      [](int i) { return 4.f + static_cast<float>(i % 5); });
}

void alternate(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  paint(
      frame, small, half, [&](int i) { return hdr(2, f % 2, i); },
      [&](int i) { return uniform(2, f % 2, i, 3, -12, 12); });
}

constexpr float near_f[] = {0.05f, 0.02f, 0.03f, 0.049f, 0.051f, 0.0625f, 0.1f, 0.2f, infinity};

// P = 20/1000 to 140/1000 m in steps of a millimetre: at frame 30 it is F.
void focus_through_f(int f, Frame& frame, CocFunction& coc) {
  coc = real_lens(LensModel::render, (20 + f) / 1000.);
  paint(
      frame, small, half, [](int i) { return hdr(3, 0, i); }, [](int i) { return one_of(near_f, 3, 0, i); });
}

void focus_down_to_f(int f, Frame& frame, CocFunction& coc) {
  coc = real_lens(LensModel::paper, 0.05 * (1 + std::ldexp(1., -f / 4)));
  paint(
      frame, small, half, [](int i) { return hdr(4, 0, i); }, [](int i) { return one_of(near_f, 4, 0, i); });
}

void infinite(int f, Frame& frame, CocFunction& coc) {
  constexpr double focus[] = {std::numeric_limits<double>::infinity(), 0.5, 1e300, 2};
  constexpr float depths[] = {infinity, 1e10f, 1e9f, 9.9e8f, 0.3f, 0.5f, 2};
  coc = real_lens(LensModel::render, focus[f % 4]);
  paint(
      frame, small, half, [&](int i) { return hdr(5, f / 4, i); }, [&](int i) { return one_of(depths, 5, f / 4, i); });
}

void bad_planar_depth(int f, Frame& frame, CocFunction& coc) {
  constexpr float depths[] = {0, -0.f, -1, nan, -nan, infinity, -infinity, 1e-42f, 1e-45f, 1e-38f, 3e38f, 1e-3f, 1, 2};
  coc = lens;
  paint(
      frame, small, half, [&](int i) { return hdr(6, f, i); }, [&](int i) { return one_of(depths, 6, f, i); });
}

void bad_coc(int f, Frame& frame, CocFunction& coc) {
  constexpr float depths[] = {0, -0.f, nan, infinity, -infinity, 1e-45f, -1e-42f, 3e38f, -3e38f, 3, -7};
  coc = coc_as_depth;
  paint(
      frame, small, float32, [&](int i) { return hdr(7, f, i); }, [&](int i) { return one_of(depths, 7, f, i); });
}

void bad_colour(int f, Frame& frame, CocFunction& coc) {
  constexpr float samples[] = {nan, infinity, -infinity, 1e30f, -1e30f, 1e-42f, 0.5f, -0.f};
  coc = coc_as_depth;
  const auto colour = [&](int i) {
    if (f == 0 || i % 50 != f % 50) return hdr(8, 0, i);
    return Rgba{one_of(samples, 8, f, i), one_of(samples, 8, f, i + 1000), 1, one_of(samples, 8, f, i + 2000)};
  };
  paint(frame, small, float32, colour, [](int i) { return static_cast<float>(i % 6); });
}

// Random colours and diameters up to `largest` px over any window.
auto wild(unsigned seed, const Window& window, float largest) {
  return [=](int f, Frame& frame, CocFunction& coc) {
    coc = coc_as_depth;
    paint(
        frame, window, half, [&](int i) { return hdr(seed, f, i, uniform(seed, f, i, 4, 0, 1)); },
        [&](int i) { return uniform(seed, f, i, 3, -largest, largest); });
  };
}

// Diameters of 0 to 2.5 px and back in sixteenths.
void sub_pixel(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  paint(
      frame, small, half, [](int i) { return hdr(9, 0, i); },
      [&](int) { return static_cast<float>(f <= 40 ? f : 80 - f) / 16; });
}

// A floor from 8 to 16 units in halves, which are 1/128 apart there, and a focus pull along it.
void half_depth(int f, Frame& frame, CocFunction& coc) {
  const float focus = 8 + static_cast<float>(f) / 10;
  coc = {DepthKind::planar, 150, 1 / focus};
  paint(
      frame, small, half, [](int i) { return hdr(10, 0, i); },
      [](int i) { return std::round((8 + 8 * static_cast<float>(i) / 384) * 128) / 128; });
}

void negative(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  const auto channel = [&](int i, int c) { return uniform(11, f, i, c, -1000, 1000); };
  paint(
      frame, small, float32,
      [&](int i) {
        return Rgba{channel(i, 0), channel(i, 1), channel(i, 2), 1};
      },
      [&](int i) { return uniform(11, f, i, 3, -10, 10); });
}

// Premultiplied: the brightest pixels are almost transparent.
void bright_and_thin(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  const auto colour = [&](int i) {
    const bool bright = f > 0 && uniform(12, f, i, 0, 0, 1) < 0.1f;
    return bright ? Rgba{65504, 60000, 65504, 1e-3f} : Rgba{1e-4f, 2e-4f, 1e-5f, 0.5f};
  };
  paint(frame, small, half, colour, [&](int i) { return uniform(12, f / 2, i, 3, 0, 10); });
}

void opaque_or_not(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  paint(
      frame, small, half, [&](int i) { return hdr(13, f, i, f % 2 == 0 ? 1 : uniform(13, f, i, 4, 0, 1)); },
      [&](int i) { return uniform(13, f, i, 3, -10, 10); });
}

void half_then_float(int f, Frame& frame, CocFunction& coc) {
  coc = coc_as_depth;
  paint(
      frame, small, f % 2 == 0 ? half : float32, [&](int i) { return hdr(14, f, i); },
      [&](int i) { return uniform(14, f, i, 3, -10, 10); });
}

// splitmix64's finaliser (Steele, Lea and Flood 2014).
std::uint64_t scramble(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

}  // namespace

float uniform(unsigned seed, int frame, int pixel, int what, float low, float high) {
  const auto part = [](int value, int shift) { return static_cast<std::uint64_t>(value) << shift; };
  const std::uint64_t bits =
      scramble(part(static_cast<int>(seed), 56) ^ part(frame, 32) ^ part(pixel, 8) ^ part(what, 0));
  return low + (high - low) * (static_cast<float>(bits >> 40) * 0x1p-24f);
}

std::ostream& operator<<(std::ostream& out, const HardShot& shot) { return out << shot.name; }

const std::vector<HardShot>& hard_shots() {
  static const std::vector<HardShot> shots{
      {"65504 flickers over 1e-5", small, 10, 10000, flicker},
      {"two HDR frames in turn", small, 12, 100, alternate},
      {"focus passes P = F over U = F, `--lens render`", small, 40, 121, focus_through_f},
      {"focus falls to F(1 + 2^-20), `--lens paper`", small, 12, 81, focus_down_to_f},
      {"P and U infinite and finite in turn", small, 12, 40, infinite},
      {"depth 0, negative, NaN, infinite, denormal", small, 12, 40, bad_planar_depth},
      {"the same as signed CoC", small, 12, 40, bad_coc},
      {"NaN, infinite and 1e30 colours", small, 12, 60, bad_colour},
      {"CoC 14 times wider than the image", {0, 0, 7, 5}, 100, 30, wild(15, {0, 0, 7, 5}, 100)},
      {"CoC 0 to 2.5 px and back", small, 12, 81, sub_pixel},
      {"half depth, focus pull", small, 12, 81, half_depth},
      {"colours from -1000 to 1000", small, 12, 60, negative},
      {"one pixel", {0, 0, 1, 1}, 60, 60, wild(16, {0, 0, 1, 1}, 60)},
      {"one column", {0, 0, 1, 40}, 60, 40, wild(17, {0, 0, 1, 40}, 60)},
      {"one row", {0, 0, 40, 1}, 60, 40, wild(18, {0, 0, 40, 1}, 60)},
      {"65504 at alpha 0.001 over the dark", small, 12, 100, bright_and_thin},
      {"opaque and transparent in turn", small, 12, 60, opaque_or_not},
      {"half and float32 in turn", small, 12, 60, half_then_float},
  };
  return shots;
}

}  // namespace pullfocus::test
