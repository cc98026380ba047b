#include "bench/naive_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "image/sanitise.h"
#include "importance/segment.h"

namespace pullfocus::cli::bench {

namespace {

template <typename Real>
NaiveKernel<Real> table_of(const Kernel& kernel) {
  NaiveKernel<Real> table;
  table.radius_y = kernel.radius_y;
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    table.weights.resize(table.weights.size() + NaiveKernel<Real>::kZeros);
    int first = -kernel.radius_x, last = kernel.radius_x;
    while (first < last && kernel.weight(first, dy) == 0) ++first;
    while (last > first && kernel.weight(last, dy) == 0) --last;
    table.rows.push_back({first, last - first + 1, table.weights.size()});
    for (int dx = first; dx <= last; ++dx) {
      table.weights.push_back(
          static_cast<Real>(static_cast<double>(kernel.weight(dx, dy)) / static_cast<double>(kWeightUnit)));
    }
  }
  table.weights.resize(table.weights.size() + NaiveKernel<Real>::kZeros);
  return table;
}

constexpr std::size_t round_up(std::size_t value, std::size_t step) { return (value + step - 1) / step * step; }

}  // namespace

template <typename Real>
NaiveFilter<Real>::NaiveFilter(const KernelTable& kernels, Way way) : kernels_(kernels), way_(way) {
  for (int i = 0; i < kernels.coc().size(); ++i) tables_.push_back(table_of<Real>(kernels.kernel(i)));
}

template <typename Real>
void NaiveFilter<Real>::read(const Frame& frame, const CocFunction& coc) {
  const Window& w = frame.window();
  const auto width = static_cast<std::size_t>(w.width());
  index_.resize(w.pixels());
  colour_.resize(w.pixels() * 4);
  const DepthToIndex to_index(coc, kernels_.coc());
  std::atomic<int> largest = 0;
  tbb::parallel_for(w.y0, w.y1, [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y - w.y0) * width;
    int of_row = 0;
    for (std::size_t x = 0; x < width; x += kTileWidth) {
      const int n = static_cast<int>(std::min(width - x, std::size_t{kTileWidth}));
      of_row = std::max(of_row, signed_indices(to_index, frame.depth.row(y) + x, n, &index_[first + x]).largest);
    }
    dispatch(frame.colour.type(), [&]<SampleType type>() {
      const auto* in = reinterpret_cast<const Pixel<type>*>(frame.colour.pixel(w.x0, y));
      Real* out = &colour_[first * 4];
      for (std::size_t x = 0; x < width; ++x, ++in, out += 4) {
        for (int c = 0; c < 4; ++c) out[c] = static_cast<Real>(sample_value(in->rgba[c]));
        out[3] = 1;
      }
    });
    int seen = largest;
    while (seen < of_row && !largest.compare_exchange_weak(seen, of_row)) {
    }
  });
  reach_x_ = reach_y_ = 0;
  for (int i = 0; i <= largest; ++i) {
    reach_x_ = std::max(reach_x_, kernels_.kernel(i).radius_x);
    reach_y_ = std::max(reach_y_, kernels_.kernel(i).radius_y);
  }
}

template <typename Real>
void NaiveFilter<Real>::divide(const NaiveBand<Real>& band, int width) {
  const std::size_t across = way_ == Way::by_row ? 1 : 4, deep = way_ == Way::by_row ? band.plane : 1;
  for (int y = band.y0; y < band.y1; ++y) {
    const Real* in =
        band.sums + static_cast<std::size_t>(y - band.y0) * band.row + static_cast<std::size_t>(band.pad) * across;
    Real* out = &result_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 4];
    for (int x = 0; x < width; ++x, in += across, out += 4) {
      const Real scale = 1 / in[3 * deep];
      for (std::size_t c = 0; c < 3; ++c) out[c] = in[c * deep] * scale;
      out[3] = 1;
    }
  }
}

template <typename Real>
const std::vector<Real>& NaiveFilter<Real>::filter(const Frame& frame, const CocFunction& coc) {
  read(frame, coc);
  const int width = frame.window().width(), height = frame.window().height();
  constexpr std::size_t line = 64 / sizeof(Real), zeros = NaiveKernel<Real>::kZeros;
  const std::size_t pad = round_up(static_cast<std::size_t>(reach_x_), zeros);
  std::size_t plane = round_up(pad + static_cast<std::size_t>(width + reach_x_) + zeros, line);
  if (plane * sizeof(Real) % 1024 == 0) plane += line;  // rows a power of two apart would share cache sets
  const std::size_t row = 4 * plane;
  result_.resize(frame.window().pixels() * 4);
  sums_.resize(row * static_cast<std::size_t>(height));
  constexpr int kRows = 64;  // of a band
  tbb::parallel_for(0, (height + kRows - 1) / kRows, [&](int b) {
    const int y0 = b * kRows, y1 = std::min(y0 + kRows, height);
    const NaiveBand<Real> band{
        sums_.data() + static_cast<std::size_t>(y0) * row, row, plane, static_cast<int>(pad), y0, y1};
    std::fill(band.sums, band.sums + static_cast<std::size_t>(y1 - y0) * row, Real{0});
    for (int y = std::max(0, y0 - reach_y_); y < std::min(height, y1 + reach_y_); ++y) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
      naive_scatter_row(way_, tables_, &index_[at], &colour_[at * 4], width, y, band);
    }
    divide(band, width);
  });
  return result_;
}

template class NaiveFilter<float>;
template class NaiveFilter<double>;

}  // namespace pullfocus::cli::bench
