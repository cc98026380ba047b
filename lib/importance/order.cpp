#include "importance/order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "importance/distance.h"
#include "importance/gain.h"
#include "importance/tile_sets.h"

namespace pullfocus {

namespace {

using Colour = std::array<double, 3>;

double product(const Colour& a, const Colour& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Colour difference(const Colour& a, const Colour& b) noexcept { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// The change of one pixel; coordinates from the window's corner.
template <SampleType type>
class PixelChange {
 public:
  PixelChange(const Pending& pending, const ImportanceOptions& options)
      : pending_(pending), options_(options), window_(pending.frame.window()) {}

  float priority(int x, int y) const noexcept {
    const std::size_t at = position(x, y);
    if (pending_.state.index[at] == kNeverCommitted) return kFirstOfAll;
    if (options_.order != Order::fearing) return 0;
    return static_cast<float>(bucket_of(importance(x, y), options_.buckets));
  }

  double importance(int x, int y) const noexcept {
    const std::size_t at = position(x, y);
    const std::int16_t was = pending_.state.index[at], is = pending_.index[at];
    if (was == kNeverCommitted) return 0;
    const Colour change = difference(new_colour(x, y), old_colour(x, y));
    return options_.w_coc * coc_distance(pending_.kernels.coc(), kernel_of(was), kernel_of(is)) +
           options_.w_rgb * std::sqrt(product(change, change));
  }

 private:
  std::size_t position(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(window_.width()) + static_cast<std::size_t>(x);
  }

  // A held-out pixel shows itself, as one in focus does.
  static int kernel_of(std::int16_t index) noexcept { return is_source(index) ? index : 0; }

  Colour colour(const Pixel<type>& pixel) const noexcept {
    const auto sample = [&](int c) { return static_cast<double>(sample_value(pixel.rgba[c])); };
    return options_.metric({sample(0), sample(1), sample(2)});
  }
  Colour old_colour(int x, int y) const noexcept {
    return colour(load_pixel<type>(pending_.state.colour.pixel(window_.x0 + x, window_.y0 + y)));
  }
  Colour new_colour(int x, int y) const noexcept {
    return colour(pending_.sanitiser(load_pixel<type>(pending_.frame.colour.pixel(window_.x0 + x, window_.y0 + y))));
  }
  const Pending& pending_;
  const ImportanceOptions& options_;
  const Window window_;
};

std::vector<float> gains(const Gain& gain, const TileGrid& grid, const TileWork& work) {
  std::vector<float> result;
  result.reserve(static_cast<std::size_t>(work.mask.count()));
  for (int i = 0; i < kTileHeight; ++i) {
    const std::uint64_t row = work.mask.rows[i];
    if (row == 0) continue;
    const int first = std::countr_zero(row), n = static_cast<int>(std::bit_width(row)) - first;
    float priorities[kTileWidth];
    gain.row(grid.x(work.tile) + first, grid.y(work.tile) + i, n, priorities);
    for_each_pixel(row, [&](int p) { result.push_back(priorities[p - first]); });
  }
  return result;
}

}  // namespace

std::vector<std::vector<float>> priorities(const std::vector<TileWork>& tiles, const Pending& pending,
                                           const ImportanceOptions& options) {
  std::vector<std::vector<float>> result(tiles.size());
  const TileGrid grid = grid_of(pending.frame.window());
  if (options.order == Order::gain) {
    const Gain gain(pending, options.metric);
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) { result[t] = gains(gain, grid, tiles[t]); });
    return result;
  }
  dispatch(pending.frame.colour.type(), [&]<SampleType type>() {
    const PixelChange<type> change(pending, options);
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
      result[t].reserve(static_cast<std::size_t>(tiles[t].mask.count()));
      for_each_tile_pixel(grid, tiles[t], [&](int, int, int x, int y) { result[t].push_back(change.priority(x, y)); });
    });
  });
  return result;
}

}  // namespace pullfocus
