#include "filter/explain.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scatter/band.h"
#include "scatter/depth_key.h"
#include "scatter/layers.h"

namespace pullfocus {

namespace {

float diameter(const Frame& frame, const CocFunction& coc, int x, int y) {
  const float depth = frame.depth.at(x, y);
  return is_background(coc.kind, depth) ? coc.background() : coc(depth);
}

// Whether a coordinate is mirrored an odd number of times.
bool is_flipped(int x, int size) noexcept { return (x >= 0 ? x / size : (size - 1 - x) / size) % 2 != 0; }

// Weight that `kernel` at (sx, sy) gives the target, mirror images included (each with the kernel as it is: see
// scatter/edges.h). Nothing at offsets -hidden .. hidden - 1 both ways. Sizes of the window.
std::int64_t weight_at(const Kernel& kernel, int sx, int sy, int tx, int ty, int width, int height, int hidden) {
  std::int64_t weight = 0;
  for (int y = sy - kernel.radius_y; y <= sy + kernel.radius_y; ++y) {
    if (mirror(y, height) != ty) continue;
    for (int x = sx - kernel.radius_x; x <= sx + kernel.radius_x; ++x) {
      if (mirror(x, width) != tx) continue;
      if (x - sx >= -hidden && x - sx < hidden && y - sy >= -hidden && y - sy < hidden) continue;
      weight += kernel.weight(is_flipped(x, width) ? sx - x : x - sx, is_flipped(y, height) ? sy - y : y - sy);
    }
  }
  return weight;
}

// Fills in the shares from the weights, as resolve_layers() does.
void accept(std::vector<LayerShare>& layers) {
  LayerShare* farthest = nullptr;
  int reached = 0;
  double free = 1;
  for (LayerShare& layer : layers) {
    if (layer.weight == 0) continue;
    layer.share = std::min(layer.weight, free);
    free -= layer.share;
    farthest = &layer;
    ++reached;
  }
  if (farthest != nullptr) farthest->share = reached == 1 ? 1 : farthest->share + free;
}

}  // namespace

Explanation explain(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, int x, int y,
                    std::size_t most, const VisibilityOptions& visibility) {
  const Window& w = frame.window();
  Explanation story;
  story.depth = frame.depth.at(x, y);
  story.background = is_background(coc.kind, story.depth);
  story.coc_px = diameter(frame, coc, x, y);
  story.index = kernels.coc().index(story.coc_px);
  story.diameter_px = kernels.coc().diameter(story.index);

  validate(visibility);
  const bool layered = visibility.kind == VisibilityOptions::Kind::layers;
  const Layers layers(kernels.coc(), layered ? visibility.borders : std::vector<double>{});
  std::vector<LayerShare> all_layers;
  for (int l = 0; l < layers.count(); ++l) {
    const Layers::Range range = layers.range(l);
    all_layers.push_back({kernels.coc().signed_diameter(range.first), kernels.coc().signed_diameter(range.last)});
  }

  story.held_out = frame.holds_out(x, y);
  // A held-out pixel hides nothing.
  const std::uint16_t key = story.held_out ? kBackgroundKey : depth_key(coc.kind, story.depth);
  for (int sy = w.y0; sy < w.y1; ++sy) {
    for (int sx = w.x0; sx < w.x1; ++sx) {
      if (frame.holds_out(sx, sy)) continue;
      const float c = diameter(frame, coc, sx, sy);
      const Kernel& kernel = kernels.kernel(kernels.coc().index(c));
      if (std::abs(sx - x) > kernel.radius_x || std::abs(sy - y) > kernel.radius_y) continue;
      const bool hidden =
          visibility.kind == VisibilityOptions::Kind::bitmap && depth_key(coc.kind, frame.depth.at(sx, sy)) > key &&
          std::fabs(kernels.coc().diameter(kernels.coc().index(c)) - story.diameter_px) > visibility.cutoff_px;
      const std::int64_t weight = weight_at(kernel, sx - w.x0, sy - w.y0, x - w.x0, y - w.y0, w.width(), w.height(),
                                            hidden ? visibility.bitmap_size / 2 : 0);
      if (weight == 0) continue;
      const double covered = static_cast<double>(weight) / static_cast<double>(kWeightUnit);
      const int layer = layers.of(kernels.coc().index(c));
      all_layers[static_cast<std::size_t>(layer)].weight += covered;
      story.total_weight += covered;
      const float depth = frame.depth.at(sx, sy);
      story.largest.push_back({sx, sy, covered, c, layer, depth, is_background(coc.kind, depth)});
    }
  }
  story.contributors = static_cast<std::int64_t>(story.largest.size());
  accept(all_layers);
  for (Contributor& c : story.largest) {
    const LayerShare& layer = all_layers[static_cast<std::size_t>(c.layer)];
    c.share *= layer.share / layer.weight;
    if (c.x == x && c.y == y) story.own_share = c.share;
  }
  std::erase_if(all_layers, [](const LayerShare& layer) { return layer.weight == 0; });
  story.layers = std::move(all_layers);
  if (story.held_out) story.own_share = 1;
  const std::size_t kept = std::min(most, story.largest.size());
  const auto order = [&](const Contributor& a, const Contributor& b) {
    return std::tuple(-a.share, std::abs(a.y - y) + std::abs(a.x - x), a.y, a.x) <
           std::tuple(-b.share, std::abs(b.y - y) + std::abs(b.x - x), b.y, b.x);
  };
  std::partial_sort(story.largest.begin(), story.largest.begin() + static_cast<std::ptrdiff_t>(kept),
                    story.largest.end(), order);
  story.largest.resize(kept);
  return story;
}

}  // namespace pullfocus
