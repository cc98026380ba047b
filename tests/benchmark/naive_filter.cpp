#include "naive_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace pullfocus::test {

template <typename Real>
NaiveFilter<Real>::NaiveFilter(const KernelTable& kernels) : kernels_(kernels) {
  for (int i = 0; i < kernels.coc().size(); ++i) {
    const Kernel& kernel = kernels.kernel(i);
    Table table{kernel.radius_x, kernel.radius_y, {}};
    for (int dy = -table.ry; dy <= table.ry; ++dy) {
      for (int dx = -table.rx; dx <= table.rx; ++dx) {
        table.weights.push_back(
            static_cast<Real>(static_cast<double>(kernel.weight(dx, dy)) / static_cast<double>(kWeightUnit)));
      }
    }
    tables_.push_back(std::move(table));
  }
}

template <typename Real>
const std::vector<Real>& NaiveFilter<Real>::filter(const Frame& frame, const CocFunction& coc) {
  const Window& w = frame.window();
  int pad = 0;
  const auto width = static_cast<std::size_t>(w.width());
  index_.resize(w.pixels());
  colour_.resize(w.pixels() * 4);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const std::size_t at = static_cast<std::size_t>(y - w.y0) * width + (x - w.x0);
      const float z = frame.depth.at(x, y);
      index_[at] = kernels_.coc().index(is_background(coc.kind, z) ? coc.background() : coc(z));
      pad = std::max(pad, tables_[static_cast<std::size_t>(std::abs(index_[at]))].rx);
      for (int c = 0; c < 3; ++c) colour_[at * 4 + c] = static_cast<Real>(frame.colour.get(x, y, c));
      colour_[at * 4 + 3] = 1;
    }
  }
  result_.resize(w.pixels() * 4);
  const std::size_t stride = (width + 2 * static_cast<std::size_t>(pad)) * 4;
  sums_.assign(stride * static_cast<std::size_t>(w.height()), 0);
  constexpr int band = 64;
  tbb::parallel_for(0, (w.height() + band - 1) / band, [&](int b) {
    const int y0 = b * band, y1 = std::min(y0 + band, w.height());
    for (int y = std::max(0, y0 - pad); y < std::min(w.height(), y1 + pad); ++y) {
      for (int x = 0; x < w.width(); ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * width + x;
        const Table& table = tables_[static_cast<std::size_t>(std::abs(index_[at]))];
        const Real* colour = &colour_[at * 4];
        for (int dy = std::max(-table.ry, y0 - y); dy <= std::min(table.ry, y1 - 1 - y); ++dy) {
          const Real* weight = &table.weights[static_cast<std::size_t>((dy + table.ry) * (2 * table.rx + 1))];
          Real* out = &sums_[static_cast<std::size_t>(y + dy) * stride + (x + pad - table.rx) * 4];
          for (int i = 0; i <= 2 * table.rx; ++i, out += 4) {
            for (int c = 0; c < 4; ++c) out[c] += colour[c] * weight[i];
          }
        }
      }
    }
    for (int y = y0; y < y1; ++y) {
      const Real* in = &sums_[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(pad) * 4];
      Real* out = &result_[static_cast<std::size_t>(y) * width * 4];
      for (int x = 0; x < w.width(); ++x, in += 4, out += 4) {
        const Real scale = 1 / in[3];
        for (int c = 0; c < 3; ++c) out[c] = in[c] * scale;
        out[3] = 1;
      }
    }
  });
  return result_;
}

template class NaiveFilter<float>;
template class NaiveFilter<double>;

}  // namespace pullfocus::test
