#include "filter/assess.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "importance/tile_sets.h"

namespace pullfocus {

namespace {

// Least and largest value of each channel.
struct Range {
  float least[4], most[4];

  static Range empty() noexcept {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {{infinity, infinity, infinity, infinity}, {-infinity, -infinity, -infinity, -infinity}};
  }
  void widen(const Range& other) noexcept {
    for (int c = 0; c < 4; ++c) {
      least[c] = std::min(least[c], other.least[c]);
      most[c] = std::max(most[c], other.most[c]);
    }
  }
  template <SampleType type>
  void widen(const Pixel<type>& pixel) noexcept {
    for (int c = 0; c < 4; ++c) {
      const float value = sample_value(pixel.rgba[c]);
      least[c] = std::min(least[c], value);
      most[c] = std::max(most[c], value);
    }
  }
  float width() const noexcept {
    float width = 0;
    for (int c = 0; c < 4; ++c) width = std::max(width, most[c] - least[c]);
    return width;
  }
};

// Colours of a tile, committed and new. A pixel never committed shows the new one.
template <SampleType type>
Range colours_of(const TileGrid& grid, int tile, const Pending& pending) {
  Range range = Range::empty();
  const Window& w = pending.frame.window();
  const int x0 = w.x0 + grid.x(tile), y0 = w.y0 + grid.y(tile);
  for (int y = y0; y < y0 + grid.tile_height(tile); ++y) {
    const std::byte* now = pending.frame.colour.pixel(x0, y);
    const std::byte* then = pending.state.colour.pixel(x0, y);
    for (int x = 0; x < grid.tile_width(tile); ++x) {
      range.widen(pending.sanitiser(load_pixel<type>(now + static_cast<std::size_t>(x) * sizeof(Pixel<type>))));
      range.widen(load_pixel<type>(then + static_cast<std::size_t>(x) * sizeof(Pixel<type>)));
    }
  }
  return range;
}

// Widens every tile's value by those up to (dx, dy) tiles away.
template <typename Value, typename Widen>
void dilate(const TileGrid& grid, int dx, int dy, std::vector<Value>& values, Widen&& widen) {
  const int columns = grid.columns(), rows = grid.rows();
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * columns + x); };
  std::vector<Value> along(values);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      for (int i = std::max(x - dx, 0); i <= std::min(x + dx, columns - 1); ++i)
        widen(along[at(x, y)], values[at(i, y)]);
    }
  }
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      for (int i = std::max(y - dy, 0); i <= std::min(y + dy, rows - 1); ++i) widen(values[at(x, y)], along[at(x, i)]);
    }
  }
}

int tiles_in(int pixels, int size) { return (pixels + size - 1) / size; }

}  // namespace

LeftOver assess(const std::vector<TileWork>& left, const Pending& pending, const Scatter& scatter, int fill) {
  LeftOver result;
  if (left.empty()) return result;
  result.pixels = count_pixels(left);
  const TileGrid grid = grid_of(pending.frame.window());
  const auto count = static_cast<std::size_t>(grid.count());

  int largest = 0;
  for (const std::int16_t index : pending.state.index) largest = std::max(largest, reach_index(index));
  for (const TileWork& work : left) largest = std::max(largest, work.max_index);
  const int dx = tiles_in(scatter.reach_x(largest) + fill, kTileWidth);
  const int dy = tiles_in(scatter.reach_y(largest) + fill, kTileHeight);

  std::vector<std::uint8_t> touched(count);
  for (const TileWork& work : left) touched[static_cast<std::size_t>(work.tile)] = 1;
  dilate(grid, dx, dy, touched, [](std::uint8_t& to, std::uint8_t from) { to |= from; });

  std::vector<Range> colours(count);
  dispatch(pending.frame.colour.type(), [&]<SampleType type>() {
    tbb::parallel_for(0, grid.count(), [&](int tile) {
      colours[static_cast<std::size_t>(tile)] = colours_of<type>(grid, tile, pending);
    });
  });
  dilate(grid, dx, dy, colours, [](Range& to, const Range& from) { to.widen(from); });

  std::size_t reached = 0;
  for (std::size_t tile = 0; tile < count; ++tile) {
    if (touched[tile] == 0) continue;
    ++reached;
    result.error_bound = std::max(result.error_bound, static_cast<double>(colours[tile].width()));
  }
  result.share = static_cast<double>(reached) / static_cast<double>(count);
  return result;
}

void importance_of(const std::vector<TileWork>& left, const Pending& pending, const ImportanceOptions& options,
                   Plane& out) {
  const Window& w = pending.frame.window();
  out.reset(w, 0);
  const TileGrid grid = grid_of(w);
  const Priorities of(pending, options);
  tbb::parallel_for(std::size_t{0}, left.size(), [&](std::size_t t) {
    const int x = grid.x(left[t].tile), width = grid.tile_width(left[t].tile);
    for (int i = 0; i < kTileHeight; ++i) {
      if (left[t].mask.rows[i] == 0) continue;
      const int y = grid.y(left[t].tile) + i;
      float of_row[kTileWidth];
      of.row(x, y, width, of_row);
      float* to = out.row(w.y0 + y) + x;
      for_each_pixel(left[t].mask.rows[i], [&](int p) { to[p] = of_row[p]; });
    }
  });
}

}  // namespace pullfocus
