#include "reference.h"

#include <cmath>
#include <cstring>

namespace pullfocus::test {

// Reflection written as what happens: step over a border, turn round.
int reflect(int x, int size) {
  while (x < 0 || x >= size) {
    if (x < 0) x = -1 - x;
    if (x >= size) x = 2 * size - 1 - x;
  }
  return x;
}

// Whether that turns round an odd number of times.
bool is_turned(int x, int size) {
  bool turned = false;
  for (; x < 0 || x >= size; turned = !turned) x = x < 0 ? -1 - x : 2 * size - 1 - x;
  return turned;
}

namespace {

// Calls visit(x, y, weight) for every pixel a kernel at (x, y) touches. The picture goes on mirrored beyond its
// borders, with the kernels of the sources there as they are: so a pixel (dx, dy) away, seen in that mirror, gets the
// weight of the offset turned round.
template <typename Visit>
void for_each_target(const Kernel& kernel, int x, int y, int width, int height, Visit&& visit) {
  for (int dy = -kernel.radius_y - 1; dy <= kernel.radius_y + 1; ++dy) {
    for (int dx = -kernel.radius_x - 1; dx <= kernel.radius_x + 1; ++dx) {
      const int seen_dx = is_turned(x + dx, width) ? -dx : dx, seen_dy = is_turned(y + dy, height) ? -dy : dy;
      const std::int64_t weight = kernel.weight(seen_dx, seen_dy);
      if (weight != 0) visit(reflect(x + dx, width), reflect(y + dy, height), weight);
    }
  }
}

}  // namespace

std::vector<Accumulator> exact_sums(const SourceState& state, const KernelTable& kernels, int lanes,
                                    const Layers* layers, int layer) {
  const Window& w = state.colour.window();
  std::vector<Accumulator> sums(w.pixels() * static_cast<std::size_t>(lanes));
  for (int y = 0; y < w.height(); ++y) {
    for (int x = 0; x < w.width(); ++x) {
      const std::int16_t index = state.index[static_cast<std::size_t>(y) * w.width() + x];
      if (!is_source(index) || (layers != nullptr && layers->of(index) != layer)) continue;
      for_each_target(kernels.kernel(index), x, y, w.width(), w.height(), [&](int tx, int ty, std::int64_t weight) {
        Accumulator* sum = &sums[(static_cast<std::size_t>(ty) * w.width() + tx) * lanes];
        for (int lane = 0; lane < lanes; ++lane) {
          const int channel = lane == kAlphaLane ? 3 : lane;
          const double value =
              lane == kWeightLane ? 1. : static_cast<double>(state.colour.get(w.x0 + x, w.y0 + y, channel));
          sum[lane] += static_cast<Accumulator>(std::llrint(value * static_cast<double>(weight)));
        }
      });
    }
  }
  return sums;
}

bool invariant_holds(const IncrementalFilter& filter, const KernelTable& kernels) {
  for (int layer = 0; layer < filter.layers().count(); ++layer) {
    if (filter.accumulators(layer) !=
        exact_sums(filter.committed(), kernels, filter.lanes(), &filter.layers(), layer)) {
      return false;
    }
  }
  return true;
}

NaiveImage naive_scatter(const Frame& frame, const CocFunction& coc, const KernelTable& kernels) {
  const Window& w = frame.window();
  NaiveImage out{w, std::vector<double>(w.pixels() * 4)};
  std::vector<double> weights(w.pixels());
  for (int y = 0; y < w.height(); ++y) {
    for (int x = 0; x < w.width(); ++x) {
      if (frame.holds_out(w.x0 + x, w.y0 + y)) continue;
      const float z = frame.depth.at(w.x0 + x, w.y0 + y);
      const double c = is_background(coc.kind, z) ? coc.background() : coc(z);
      const int index = kernels.coc().index(static_cast<float>(c));
      for_each_target(kernels.kernel(index), x, y, w.width(), w.height(), [&](int tx, int ty, std::int64_t weight) {
        const std::size_t at = static_cast<std::size_t>(ty) * w.width() + tx;
        const double share = static_cast<double>(weight) / static_cast<double>(kWeightUnit);
        for (int channel = 0; channel < 4; ++channel) {
          out.rgba[at * 4 + channel] += share * static_cast<double>(frame.colour.get(w.x0 + x, w.y0 + y, channel));
        }
        weights[at] += share;
      });
    }
  }
  for (std::size_t i = 0; i < out.rgba.size(); ++i) {
    const int x = w.x0 + static_cast<int>(i / 4) % w.width(), y = w.y0 + static_cast<int>(i / 4) / w.width();
    const bool own = weights[i / 4] == 0 || frame.holds_out(x, y);
    out.rgba[i] =
        own ? static_cast<double>(frame.colour.get(x, y, static_cast<int>(i % 4))) : out.rgba[i] / weights[i / 4];
  }
  return out;
}

std::string difference(const ColourImage& a, const ColourImage& b) {
  if (a.type() != b.type()) return "sample types differ";
  if (!(a.window() == b.window())) return "windows differ";
  for (int y = a.window().y0; y < a.window().y1; ++y) {
    for (int x = a.window().x0; x < a.window().x1; ++x) {
      if (std::memcmp(a.pixel(x, y), b.pixel(x, y), a.pixel_bytes()) == 0) continue;
      std::string text = "pixel " + std::to_string(x) + "," + std::to_string(y) + ":";
      for (int c = 0; c < 4; ++c) {
        text.append(" ").append(std::to_string(a.get(x, y, c)));
        text.append("/").append(std::to_string(b.get(x, y, c)));
      }
      return text;
    }
  }
  return "";
}

}  // namespace pullfocus::test
