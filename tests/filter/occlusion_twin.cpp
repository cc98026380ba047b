#include "occlusion_twin.h"

#include <cmath>

#include "reference.h"

namespace pullfocus::test {

namespace {

// Whether reflect() turns round an odd number of times.
bool turns(int x, int size) {
  bool turned = false;
  for (; x < 0 || x >= size; turned = !turned) x = x < 0 ? -1 - x : 2 * size - 1 - x;
  return turned;
}

}  // namespace

std::vector<Accumulator> exact_sums_with_bitmaps(const SourceState& state, const std::vector<std::uint16_t>& keys,
                                                 const KernelTable& kernels, const VisibilityOptions& visibility,
                                                 int lanes) {
  const Window& w = state.colour.window();
  const int width = w.width(), height = w.height(), half = visibility.bitmap_size / 2;
  const auto size = [&](std::int16_t index) { return is_source(index) ? kernels.coc().diameter(index) : 0; };
  std::vector<Accumulator> sums(w.pixels() * static_cast<std::size_t>(lanes));
  for (int py = 0; py < height; ++py) {
    for (int px = 0; px < width; ++px) {
      const std::size_t p = static_cast<std::size_t>(py) * width + px;
      if (!is_source(state.index[p])) continue;
      const Kernel& kernel = kernels.kernel(state.index[p]);
      for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
        for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) {
          const std::int64_t weight =
              kernel.weight(turns(px + dx, width) ? -dx : dx, turns(py + dy, height) ? -dy : dy);
          if (weight == 0) continue;
          const std::size_t u = static_cast<std::size_t>(reflect(py + dy, height)) * width + reflect(px + dx, width);
          const bool in_window = dx >= -half && dx < half && dy >= -half && dy < half;
          const bool unlike = std::fabs(size(state.index[p]) - size(state.index[u])) > visibility.cutoff_px;
          if (in_window && unlike && keys[p] > keys[u]) continue;
          for (int lane = 0; lane < lanes; ++lane) {
            const int channel = lane == kAlphaLane ? 3 : lane;
            const double value =
                lane == kWeightLane ? 1. : static_cast<double>(state.colour.get(w.x0 + px, w.y0 + py, channel));
            sums[u * lanes + lane] += static_cast<Accumulator>(std::llrint(value * static_cast<double>(weight)));
          }
        }
      }
    }
  }
  return sums;
}

std::vector<std::uint16_t> committed_keys(const IncrementalFilter& filter) {
  const DepthPlanes& planes = filter.occlusion()->planes();
  std::vector<std::uint16_t> keys;
  for (int y = 0; y < planes.height(); ++y) keys.insert(keys.end(), planes.keys(y), planes.keys(y) + planes.width());
  return keys;
}

}  // namespace pullfocus::test
