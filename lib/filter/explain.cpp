#include "filter/explain.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "resolve/resolve.h"
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

// Of one pixel: who covers it, by layer.
struct Coverage {
  std::vector<LayerShare> layers;         // all of them
  std::vector<Contributor> contributors;  // `share` holds the weight

  double weight(std::size_t first, std::size_t last) const {
    double sum = 0;
    for (std::size_t l = first; l < last; ++l) sum += layers[l].weight;
    return sum;
  }
};

constexpr double kCovering = static_cast<double>(kCoveringWeight) / static_cast<double>(kWeightUnit);

// Fills in the shares of layers `first` and on from their weights, as resolve_layers() does.
void accept(std::vector<LayerShare>& layers, std::size_t first = 0) {
  LayerShare* farthest = nullptr;
  int reached = 0;
  double free = 1;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    LayerShare& layer = layers[l];
    layer.share = 0;
    if (layer.weight == 0 || l < first) continue;
    layer.share = std::min(layer.weight / kCovering, free);
    free -= layer.share;
    farthest = &layer;
    ++reached;
  }
  if (farthest != nullptr) farthest->share = reached == 1 ? 1 : farthest->share + free;
}

class Onlooker {
 public:
  Onlooker(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, const VisibilityOptions& visibility)
      : frame_(frame),
        coc_(coc),
        kernels_(kernels),
        visibility_(visibility),
        layers_(kernels.coc(),
                visibility.kind == VisibilityOptions::Kind::layers ? visibility.borders : std::vector<double>{}) {
    const Window& w = frame.window();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        const Kernel& kernel = kernel_of(x, y);
        reach_x_ = std::max(reach_x_, kernel.radius_x);
        reach_y_ = std::max(reach_y_, kernel.radius_y);
      }
    }
  }

  const Layers& layers() const { return layers_; }

  Coverage look_at(int x, int y) const {
    const Window& w = frame_.window();
    Coverage found;
    for (int l = 0; l < layers_.count(); ++l) {
      const Layers::Range range = layers_.range(l);
      found.layers.push_back({kernels_.coc().signed_diameter(range.first), kernels_.coc().signed_diameter(range.last)});
    }
    // A held-out pixel hides nothing.
    const std::uint16_t key = frame_.holds_out(x, y) ? kBackgroundKey : depth_key(coc_.kind, frame_.depth.at(x, y));
    const double size = size_of(x, y);
    for (int sy = std::max(y - reach_y_, w.y0); sy < std::min(y + reach_y_ + 1, w.y1); ++sy) {
      for (int sx = std::max(x - reach_x_, w.x0); sx < std::min(x + reach_x_ + 1, w.x1); ++sx) {
        if (frame_.holds_out(sx, sy)) continue;
        const Kernel& kernel = kernel_of(sx, sy);
        if (std::abs(sx - x) > kernel.radius_x || std::abs(sy - y) > kernel.radius_y) continue;
        const float depth = frame_.depth.at(sx, sy);
        const bool hidden = visibility_.kind == VisibilityOptions::Kind::bitmap && depth_key(coc_.kind, depth) > key &&
                            std::fabs(size_of(sx, sy) - size) > visibility_.cutoff_px;
        const std::int64_t weight = weight_at(kernel, sx - w.x0, sy - w.y0, x - w.x0, y - w.y0, w.width(), w.height(),
                                              hidden ? visibility_.bitmap_size / 2 : 0);
        if (weight == 0) continue;
        const double covered = static_cast<double>(weight) / static_cast<double>(kWeightUnit);
        const float c = diameter(frame_, coc_, sx, sy);
        const int layer = layers_.of(kernels_.coc().index(c));
        found.layers[static_cast<std::size_t>(layer)].weight += covered;
        found.contributors.push_back({sx, sy, covered, c, layer, depth, is_background(coc_.kind, depth)});
      }
    }
    return found;
  }

 private:
  int index_of(int x, int y) const { return kernels_.coc().index(diameter(frame_, coc_, x, y)); }
  const Kernel& kernel_of(int x, int y) const { return kernels_.kernel(index_of(x, y)); }
  double size_of(int x, int y) const { return kernels_.coc().diameter(index_of(x, y)); }

  const Frame& frame_;
  const CocFunction& coc_;
  const KernelTable& kernels_;
  const VisibilityOptions& visibility_;
  Layers layers_;
  int reach_x_ = 0, reach_y_ = 0;  // of all kernels of the frame
};

// Adds `part` of what `seen` shows, its layers accepted, to the contributors.
void add_shares(const Coverage& seen, double part, std::vector<Contributor>& all) {
  for (Contributor c : seen.contributors) {
    const LayerShare& layer = seen.layers[static_cast<std::size_t>(c.layer)];
    c.share *= part * layer.share / layer.weight;
    all.push_back(c);
  }
}

// One entry a pixel.
void merge(std::vector<Contributor>& all) {
  std::sort(all.begin(), all.end(),
            [](const Contributor& a, const Contributor& b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); });
  std::size_t n = 0;
  for (const Contributor& c : all) {
    if (n > 0 && all[n - 1].x == c.x && all[n - 1].y == c.y) {
      all[n - 1].share += c.share;
    } else {
      all[n++] = c;
    }
  }
  all.resize(n);
}

struct Sample {
  Coverage seen;
  double part;  // of the pixel's result
};

// What fills a pixel from around, as Backdrop does, where `present` covers it.
std::vector<Sample> fill(const Onlooker& onlooker, const Window& window, int x, int y, const Coverage& present) {
  std::vector<Sample> samples;
  const auto near = static_cast<std::size_t>(onlooker.layers().near()), count = present.layers.size();
  const double in_front = present.weight(0, near) / kCovering;
  if (near == 0 || near == count || in_front == 0 || present.weight(near, count) > 0) return samples;
  const double free = 1 - std::min(in_front, 1.);
  const double amount = std::min(free, 2 * (free - Backdrop::kLeastFree));
  if (amount <= 0) return samples;
  double weights = static_cast<double>(Backdrop::kPresentWeight);
  for (const auto& [dx, dy] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
    for (int d = 1; d <= Backdrop::kReach && window.contains(x + d * dx, y + d * dy); ++d) {
      Coverage seen = onlooker.look_at(x + d * dx, y + d * dy);
      if (seen.weight(0, near) == 0 || seen.weight(near, count) < Backdrop::kEnoughBehind * kCovering) continue;
      accept(seen.layers, near);
      samples.push_back({std::move(seen), 1. / d - 1. / (Backdrop::kReach + 1)});
      weights += samples.back().part;
      break;
    }
  }
  for (Sample& sample : samples) sample.part *= amount / weights;
  return samples;
}

}  // namespace

Explanation explain(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, int x, int y,
                    std::size_t most, const VisibilityOptions& visibility) {
  validate(visibility);
  Explanation story;
  story.depth = frame.depth.at(x, y);
  story.background = is_background(coc.kind, story.depth);
  story.coc_px = diameter(frame, coc, x, y);
  story.index = kernels.coc().index(story.coc_px);
  story.diameter_px = kernels.coc().diameter(story.index);
  story.held_out = frame.holds_out(x, y);

  const Onlooker onlooker(frame, coc, kernels, visibility);
  Coverage own = onlooker.look_at(x, y);
  accept(own.layers);
  story.contributors = static_cast<std::int64_t>(own.contributors.size());
  story.total_weight = own.weight(0, own.layers.size());
  const std::vector<Sample> samples = fill(onlooker, frame.window(), x, y, own);
  for (const Sample& sample : samples) story.filled_share += sample.part;
  for (LayerShare& layer : own.layers) layer.share *= 1 - story.filled_share;
  add_shares(own, 1, story.largest);
  for (const Sample& sample : samples) add_shares(sample.seen, sample.part, story.largest);
  merge(story.largest);
  for (const Contributor& c : story.largest) {
    if (c.x == x && c.y == y) story.own_share = c.share;
  }
  if (story.held_out) story.own_share = 1;
  std::erase_if(own.layers, [](const LayerShare& layer) { return layer.weight == 0; });
  story.layers = std::move(own.layers);

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
