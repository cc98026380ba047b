#include "metrics/convolve.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace pullfocus {

Taps make_taps(int radius, const std::function<double(double)>& weight) {
  Taps taps;
  for (int i = -radius; i <= radius; ++i) taps.push_back(weight(i));
  return taps;
}

namespace {

void correlate_row(const double* in, int width, const Taps& taps, std::vector<double>& padded, double* out) {
  const int radius = static_cast<int>(taps.size() / 2);
  padded.resize(static_cast<std::size_t>(width + 2 * radius));
  for (int i = 0; i < width + 2 * radius; ++i) {
    padded[static_cast<std::size_t>(i)] = in[std::clamp(i - radius, 0, width - 1)];
  }
  std::fill_n(out, width, 0.0);
  for (std::size_t i = 0; i < taps.size(); ++i) {
    for (int x = 0; x < width; ++x) out[x] += taps[i] * padded[static_cast<std::size_t>(x) + i];
  }
}

}  // namespace

Grid correlate(const Grid& in, const Taps& across, const Taps& down) {
  const Window& w = in.window;
  Grid rows(w), out(w);
  tbb::parallel_for(tbb::blocked_range<int>(w.y0, w.y1, 16), [&](const tbb::blocked_range<int>& range) {
    std::vector<double> padded;
    for (int y = range.begin(); y < range.end(); ++y) correlate_row(in.row(y), w.width(), across, padded, rows.row(y));
  });
  const int radius = static_cast<int>(down.size() / 2);
  tbb::parallel_for(tbb::blocked_range<int>(w.y0, w.y1, 16), [&](const tbb::blocked_range<int>& range) {
    for (int y = range.begin(); y < range.end(); ++y) {
      double* sums = out.row(y);
      for (std::size_t j = 0; j < down.size(); ++j) {
        const double* from = rows.row(std::clamp(y + static_cast<int>(j) - radius, w.y0, w.y1 - 1));
        for (int x = 0; x < w.width(); ++x) sums[x] += down[j] * from[x];
      }
    }
  });
  return out;
}

}  // namespace pullfocus
