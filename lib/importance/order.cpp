#include "importance/order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "importance/distance.h"
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
      : pending_(pending), options_(options), window_(pending.frame.window()) {
    for (int index = 0; index < pending.kernels.coc().size(); ++index) {
      const double area = pending.kernels.area(index);
      shares_.push_back({1 / area, 1 / std::sqrt(std::sqrt(area))});
    }
  }

  float priority(int x, int y) const noexcept {
    const std::size_t at = position(x, y);
    if (pending_.state.index[at] == kNeverCommitted) return kFirstOfAll;
    switch (options_.order) {
      case Order::gain:
        return static_cast<float>(std::max(0., gain(x, y)));
      case Order::fearing:
        return static_cast<float>(bucket_of(importance(x, y), options_.buckets));
      case Order::random:
        return 0;
    }
    return 0;
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

  double gain(int x, int y) const noexcept {
    const std::size_t at = position(x, y);
    const std::int16_t was = pending_.state.index[at], is = pending_.index[at];
    const Colour now = new_colour(x, y), then = old_colour(x, y);
    const Colour change = difference(now, then);
    const double changed = product(change, change);
    const Shares &now_of = shares(is), &then_of = shares(was);
    const double of_colour = changed * std::max(now_of.fourth_root, then_of.fourth_root);
    if (was == is) return of_colour;
    const Colour result = shown(x, y), a = difference(now, result), b = difference(then, result);
    const double of_kernel = product(a, a) * now_of.area + product(b, b) * then_of.area -
                             2 * product(a, b) * std::min(now_of.area, then_of.area);
    return changed > 0 ? std::max(of_kernel, of_colour) : of_kernel * spread(at);
  }

  // A held-out pixel shows itself, as one in focus does.
  static int kernel_of(std::int16_t index) noexcept { return is_source(index) ? index : 0; }

  // In [0, 1), another for every pixel and call.
  double spread(std::size_t at) const noexcept {
    return 0x1p-32 * static_cast<double>(scrambled(static_cast<std::uint32_t>(at) + 0x9e3779b9u * pending_.round));
  }

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
  Colour shown(int x, int y) const noexcept {
    const std::byte* pixel = pending_.shown.pixel(window_.x0 + x, window_.y0 + y);
    const auto of = [&]<SampleType shown_type>(const Pixel<shown_type>& p) {
      const auto sample = [&](int c) { return static_cast<double>(sample_value(p.rgba[c])); };
      return options_.metric({sample(0), sample(1), sample(2)});
    };
    if (pending_.shown.type() == SampleType::half) return of(load_pixel<SampleType::half>(pixel));
    return of(load_pixel<SampleType::float32>(pixel));
  }

  // Of a kernel's area A: 1 / A and 1 / A^(1/4).
  struct Shares {
    double area, fourth_root;
  };
  const Shares& shares(std::int16_t index) const noexcept {
    return shares_[static_cast<std::size_t>(std::abs(kernel_of(index)))];
  }

  const Pending& pending_;
  const ImportanceOptions& options_;
  const Window window_;
  std::vector<Shares> shares_;  // by |index|
};

}  // namespace

std::vector<std::vector<float>> priorities(const std::vector<TileWork>& tiles, const Pending& pending,
                                           const ImportanceOptions& options) {
  std::vector<std::vector<float>> result(tiles.size());
  const TileGrid grid = grid_of(pending.frame.window());
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
