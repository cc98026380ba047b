#include "hard_twins.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "reference.h"

namespace pullfocus::test {

namespace {

constexpr std::size_t kLanes = kAlphaLanes;

int largest_reach(const KernelTable& kernels) {
  int reach = 0;
  for (int i = 0; i < kernels.coc().size(); ++i) {
    reach = std::max({reach, kernels.kernel(i).radius_x, kernels.kernel(i).radius_y});
  }
  return reach + 1;
}

std::vector<int> reflections(int reach, int size) {
  std::vector<int> where;
  for (int x = -reach; x < size + reach; ++x) where.push_back(reflect(x, size));
  return where;
}

// Calls visit(pixel, x, y), row by row, counted from the corner.
template <typename Visit>
void for_each_pixel_of(const Footprints& footprints, Visit&& visit) {
  std::size_t pixel = 0;
  for (int y = 0; y < footprints.height(); ++y) {
    for (int x = 0; x < footprints.width(); ++x) visit(pixel++, x, y);
  }
}

long double sanitised(float sample, float largest) {
  if (!std::isfinite(sample)) return 0;
  return std::clamp(sample, -largest, largest);
}

long double half_ulp(long double value) {
  const float magnitude = std::fabs(static_cast<float>(value));
  return (static_cast<long double>(std::nextafter(magnitude, INFINITY)) - static_cast<long double>(magnitude)) / 2;
}

}  // namespace

Footprints::Footprints(const Window& window, std::shared_ptr<const KernelTable> kernels)
    : kernels_(std::move(kernels)), width_(window.width()), height_(window.height()), reach_(largest_reach(*kernels_)) {
  rows_ = reflections(reach_, height_);
  columns_ = reflections(reach_, width_);
}

const std::vector<Footprints::Part>& Footprints::parts(int index) {
  const auto [found, is_new] = parts_.try_emplace(std::abs(index));
  if (is_new) {
    const Kernel& kernel = kernels_->kernel(index);
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      for (int dx = -kernel.radius_x; dx <= kernel.radius_x; ++dx) {
        if (const std::int64_t weight = kernel.weight(dx, dy); weight != 0) found->second.push_back({dx, dy, weight});
      }
    }
  }
  return found->second;
}

int Footprints::index_of(const CocFunction& coc, float depth) const {
  return kernels_->coc().index(is_background(coc.kind, depth) ? coc.background() : coc(depth));
}

FloatTwin::FloatTwin(const Window& window, std::shared_ptr<const KernelTable> kernels)
    : footprints_(window, std::move(kernels)), committed_(window.pixels()), sums_(window.pixels() * kLanes) {}

void FloatTwin::add(std::size_t pixel, const Source& source, float sign) {
  const auto width = static_cast<std::size_t>(footprints_.width());
  const auto x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
  footprints_.for_each_target(source.index, x, y, [&](std::size_t target, std::int64_t weight) {
    const float w = sign * static_cast<float>(static_cast<double>(weight) / static_cast<double>(kWeightUnit));
    float* sums = &sums_[target * kLanes];
    for (int c = 0; c < 3; ++c) sums[c] += source.rgba[c] * w;
    sums[kWeightLane] += w;
    sums[kAlphaLane] += source.rgba[3] * w;
  });
}

void FloatTwin::filter(const Frame& frame, const CocFunction& coc) {
  const Window& w = frame.window();
  for_each_pixel_of(footprints_, [&](std::size_t pixel, int x, int y) {
    Source source{};
    for (int c = 0; c < 4; ++c) source.rgba[c] = frame.colour.get(w.x0 + x, w.y0 + y, c);
    source.index = footprints_.index_of(coc, frame.depth.at(w.x0 + x, w.y0 + y));
    Source& old = committed_[pixel];
    if (!first_ && source.index == old.index && std::memcmp(source.rgba, old.rgba, sizeof old.rgba) == 0) return;
    if (!first_) add(pixel, old, -1);
    add(pixel, source, 1);
    old = source;
  });
  first_ = false;
}

std::vector<float> FloatTwin::picture() const {
  std::vector<float> rgba;
  for (std::size_t at = 0; at < sums_.size(); at += kLanes) {
    for (const std::size_t lane : {0, 1, 2, kAlphaLane}) rgba.push_back(sums_[at + lane] / sums_[at + kWeightLane]);
  }
  return rgba;
}

TruePicture true_picture(const Frame& frame, const CocFunction& coc, Footprints& footprints) {
  const Window& w = frame.window();
  const float largest = footprints.kernels().options().max_radiance;
  TruePicture picture{std::vector<long double>(w.pixels() * 4), std::vector<long double>(w.pixels() * 4)};
  std::vector<long double> weights(w.pixels()), contributions(w.pixels());
  for_each_pixel_of(footprints, [&](std::size_t, int x, int y) {
    long double rgba[4];
    for (int c = 0; c < 4; ++c) rgba[c] = sanitised(frame.colour.get(w.x0 + x, w.y0 + y, c), largest);
    const int index = footprints.index_of(coc, frame.depth.at(w.x0 + x, w.y0 + y));
    footprints.for_each_target(index, x, y, [&](std::size_t target, std::int64_t weight) {
      const auto share = static_cast<long double>(weight);
      for (std::size_t c = 0; c < 4; ++c) picture.rgba[target * 4 + c] += rgba[c] * share;
      weights[target] += share;
      contributions[target] += 1;
    });
  });
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    picture.rgba[i] /= weights[i / 4];
    // The quotient itself is taken in double: some 2^-52 of the value.
    picture.bound[i] =
        contributions[i / 4] / 2 / weights[i / 4] + half_ulp(picture.rgba[i]) + std::fabs(picture.rgba[i]) * 0x1p-50L;
  }
  return picture;
}

std::vector<WideSum> wide_sums(const SourceState& state, Footprints& footprints) {
  const Window& w = state.colour.window();
  std::vector<WideSum> sums(w.pixels() * kLanes);
  for_each_pixel_of(footprints, [&](std::size_t pixel, int x, int y) {
    if (state.index[pixel] == kNeverCommitted) return;
    double values[kLanes];
    for (int c = 0; c < 3; ++c) values[c] = static_cast<double>(state.colour.get(w.x0 + x, w.y0 + y, c));
    values[kWeightLane] = 1;
    values[kAlphaLane] = static_cast<double>(state.colour.get(w.x0 + x, w.y0 + y, 3));
    footprints.for_each_target(state.index[pixel], x, y, [&](std::size_t target, std::int64_t weight) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        sums[target * kLanes + lane] += std::llrint(values[lane] * static_cast<double>(weight));
      }
    });
  });
  return sums;
}

std::vector<Accumulator> sums_with_alpha(const IncrementalFilter& filter) {
  const auto sums = filter.accumulators();
  if (filter.lanes() == kAlphaLanes) return {sums.begin(), sums.end()};
  std::vector<Accumulator> wide;
  for (std::size_t at = 0; at < sums.size(); at += kOpaqueLanes) {
    for (std::size_t lane = 0; lane < kOpaqueLanes; ++lane) wide.push_back(sums[at + lane]);
    wide.push_back(sums[at + kWeightLane]);
  }
  return wide;
}

bool holds(const IncrementalFilter& filter, const std::vector<WideSum>& expected) {
  return std::ranges::equal(sums_with_alpha(filter), expected, [](Accumulator is, const WideSum& sum) {
    return static_cast<WideSum>(static_cast<std::int64_t>(is)) == sum;
  });
}

}  // namespace pullfocus::test
