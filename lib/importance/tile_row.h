// Frames and states by rows of tiles: what detection and commit share.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "importance/edge_count.h"
#include "importance/ingest.h"
#include "importance/tile_sets.h"

namespace pullfocus {

template <SampleType type>
inline constexpr std::uint32_t kOne = type == SampleType::half ? 0x3c00 : 0x3f800000;

template <SampleType type>
bool is_opaque(const Pixel<type>& pixel) noexcept {
  return pixel.rgba[3] == kOne<type>;
}

template <SampleType type>
bool are_opaque(const Pixel<type>* pixels, int n) noexcept {
  // The word that holds alpha: simple enough for the compiler to use vectors.
  using Words = std::array<std::uint64_t, sizeof(Pixel<type>) / sizeof(std::uint64_t)>;
  constexpr auto word_of = [](std::uint32_t alpha) {
    Pixel<type> pixel{};
    pixel.rgba[3] = static_cast<std::remove_reference_t<decltype(pixel.rgba[3])>>(alpha);
    return std::bit_cast<Words>(pixel).back();
  };
  constexpr std::uint64_t one = word_of(kOne<type>), alpha = word_of(~0u);
  std::uint64_t difference = 0;
  for (int i = 0; i < n; ++i) difference |= std::bit_cast<Words>(pixels[i]).back() ^ one;
  return (difference & alpha) == 0;
}

inline std::size_t position(const TileGrid& grid, int x, int y) noexcept {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
}

// Of the pixel x, y from the window's corner, and those to its right.
template <SampleType type>
Pixel<type>* pixels_of(ColourImage& image, int x, int y) noexcept {
  return reinterpret_cast<Pixel<type>*>(image.pixel(image.window().x0 + x, image.window().y0 + y));
}

template <SampleType type>
const Pixel<type>* pixels_of(const ColourImage& image, int x, int y) noexcept {
  return pixels_of<type>(const_cast<ColourImage&>(image), x, y);
}

// One row of tiles: what its task found.
struct TileRow {
  std::vector<TileWork> tiles;
  std::int64_t pixels = 0;
  bool opaque = true;
  EdgeCount edges;
  FrameFindings findings;
};

}  // namespace pullfocus
