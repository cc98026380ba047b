#include "importance/order.h"

#include <cmath>

#include "importance/distance.h"
#include "importance/gain.h"

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

}  // namespace

Priorities::Priorities(const Pending& pending, const ImportanceOptions& options)
    : pending_(pending),
      options_(options),
      gain_(options.order == Order::gain ? std::make_unique<Gain>(pending, options.metric) : nullptr) {}

Priorities::~Priorities() = default;

template <SampleType type>
void Priorities::row_of_pixels(int x, int y, int n, float* out) const noexcept {
  const PixelChange<type> change(pending_, options_);
  for (int i = 0; i < n; ++i) out[i] = change.priority(x + i, y);
}

std::uint64_t Priorities::row(int x, int y, int n, float* out) const noexcept {
  if (gain_) return gain_->row(x, y, n, out);
  dispatch(pending_.frame.colour.type(), [&]<SampleType type>() { row_of_pixels<type>(x, y, n, out); });
  return 0;
}

}  // namespace pullfocus
