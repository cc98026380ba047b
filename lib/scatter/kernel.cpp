#include "scatter/kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace pullfocus {

namespace {

struct Shares {
  int rx, ry;
  const std::vector<std::int32_t>& values;
  std::int32_t at(int dx, int dy) const {
    if (std::abs(dx) > rx || std::abs(dy) > ry) return 0;
    return values[static_cast<std::size_t>((dy + ry) * (2 * rx + 1) + dx + rx)];
  }
};

// Smallest centred footprint that holds every share > 0.
void trim(const Shares& shares, Kernel& kernel) {
  for (int dy = -shares.ry; dy <= shares.ry; ++dy) {
    for (int dx = -shares.rx; dx <= shares.rx; ++dx) {
      if (shares.at(dx, dy) == 0) continue;
      kernel.radius_x = std::max(kernel.radius_x, std::abs(dx));
      kernel.radius_y = std::max(kernel.radius_y, std::abs(dy));
    }
  }
}

KernelEdge make_edge(Kernel& kernel, int dx, std::uint8_t from, std::uint8_t to) {
  const KernelStep step{std::min(from, to), std::max(from, to)};
  const auto same = [&](const KernelStep& s) { return s.low == step.low && s.high == step.high; };
  auto found = std::find_if(kernel.steps.begin(), kernel.steps.end(), same);
  if (found == kernel.steps.end()) found = kernel.steps.insert(found, step);
  return {static_cast<std::int16_t>(dx), static_cast<std::uint8_t>(found - kernel.steps.begin()), from < to};
}

}  // namespace

Kernel kernel_from_shares(int rx, int ry, const std::vector<std::int32_t>& values) {
  const Shares shares{rx, ry, values};
  Kernel kernel;
  trim(shares, kernel);

  const std::int32_t largest = *std::max_element(values.begin(), values.end());
  std::vector<std::uint8_t> level_of_share(static_cast<std::size_t>(largest) + 1);
  for (const std::int32_t share : values) level_of_share[static_cast<std::size_t>(share)] = 1;
  level_of_share[0] = 1;
  std::vector<std::int32_t> distinct;
  for (std::int32_t share = 0; share <= largest; ++share) {
    if (level_of_share[static_cast<std::size_t>(share)] == 0) continue;
    level_of_share[static_cast<std::size_t>(share)] = static_cast<std::uint8_t>(distinct.size());
    distinct.push_back(share);
  }
  assert(distinct.size() > 1 && distinct.size() <= 256);

  const auto sum = std::accumulate(values.begin(), values.end(), std::int64_t{0});
  const std::int64_t weight_of_share = (kWeightUnit + sum / 2) / sum;
  for (const std::int32_t share : distinct) kernel.levels.push_back(share * weight_of_share);

  kernel.row_begin.push_back(0);
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    std::uint8_t level = 0;
    for (int dx = -kernel.radius_x; dx <= kernel.radius_x + 1; ++dx) {
      const std::uint8_t next = level_of_share[static_cast<std::size_t>(shares.at(dx, dy))];
      if (next == level) continue;
      kernel.edges.push_back(make_edge(kernel, dx, level, next));
      level = next;
    }
    kernel.row_begin.push_back(static_cast<std::uint32_t>(kernel.edges.size()));
  }
  if (kernel.steps.size() > kMaxKernelSteps) throw std::logic_error("a kernel has too many kinds of edges");
  return kernel;
}

std::int64_t Kernel::weight(int dx, int dy) const noexcept {
  if (std::abs(dy) > radius_y) return 0;
  std::size_t level = 0;
  for (const KernelEdge& edge : row(dy)) {
    if (edge.dx <= dx) level = level_behind(edge);
  }
  return levels[level];
}

std::int64_t Kernel::total() const noexcept {
  std::int64_t sum = 0;
  for (int dy = -radius_y; dy <= radius_y; ++dy) {
    for (int dx = -radius_x; dx <= radius_x; ++dx) sum += weight(dx, dy);
  }
  return sum;
}

}  // namespace pullfocus
