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

struct Level {
  std::int32_t share;
  std::int64_t pixels;
};

// Ascending, share 0 first.
std::vector<Level> distinct_shares(const std::vector<std::int32_t>& values) {
  std::vector<Level> levels{{0, 0}};
  std::size_t last = 0;
  for (const std::int32_t value : values) {
    if (levels[last].share != value) {
      auto found = std::lower_bound(levels.begin(), levels.end(), value,
                                    [](const Level& level, std::int32_t share) { return level.share < share; });
      if (found == levels.end() || found->share != value) found = levels.insert(found, {value, 0});
      last = static_cast<std::size_t>(found - levels.begin());
    }
    ++levels[last].pixels;
  }
  return levels;
}

// Nearest integers to unit * share / sum, some of them moved by one count to bring their total closer to the unit.
std::vector<std::int64_t> weights(const std::vector<Level>& levels) {
  std::int64_t sum = 0;
  for (const Level& level : levels) sum += level.share * level.pixels;
  std::vector<std::int64_t> result;
  std::int64_t missing = kWeightUnit;
  for (const Level& level : levels) {
    const double exact = static_cast<double>(level.share) / static_cast<double>(sum) * static_cast<double>(kWeightUnit);
    result.push_back(std::llrint(exact));
    missing -= result.back() * level.pixels;
  }
  std::vector<std::size_t> order(levels.size() - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return levels[a].pixels > levels[b].pixels; });
  for (const std::size_t k : order) {
    if (2 * std::abs(missing) <= levels[k].pixels) continue;
    const int by = missing > 0 ? 1 : -1;
    result[k] += by;
    missing -= by * levels[k].pixels;
  }
  return result;
}

KernelEdge make_edge(Kernel& kernel, int dx, std::uint8_t from, std::uint8_t to) {
  const KernelStep step{std::min(from, to), std::max(from, to)};
  const auto same = [&](const KernelStep& s) { return s.low == step.low && s.high == step.high; };
  auto found = std::find_if(kernel.steps.begin(), kernel.steps.end(), same);
  if (found == kernel.steps.end()) found = kernel.steps.insert(found, step);
  return {static_cast<std::int16_t>(dx), static_cast<std::uint8_t>(found - kernel.steps.begin()), from < to};
}

}  // namespace

Kernel reflected(const Kernel& kernel) {
  Kernel result = kernel;
  result.row_begin.assign(1, 0);
  result.edges.clear();
  for (int dy = kernel.radius_y; dy >= -kernel.radius_y; --dy) {
    const auto row = kernel.row(dy);
    for (auto edge = row.rbegin(); edge != row.rend(); ++edge) {
      result.edges.push_back({static_cast<std::int16_t>(1 - edge->dx), edge->step, !edge->rising});
    }
    result.row_begin.push_back(static_cast<std::uint32_t>(result.edges.size()));
  }
  return result;
}

Mirrors mirrors_of(const Kernel& kernel) {
  const auto equal = [](const KernelEdge& a, const KernelEdge& b) {
    return a.dx == b.dx && a.step == b.step && a.rising == b.rising;
  };
  const auto opposite = [](const KernelEdge& a, const KernelEdge& b) {
    return a.dx == 1 - b.dx && a.step == b.step && a.rising != b.rising;
  };
  Mirrors mirrors{true, true, true};
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    const auto row = kernel.row(dy), other = kernel.row(-dy);
    mirrors.x &= std::equal(row.begin(), row.end(), row.rbegin(), row.rend(), opposite);
    mirrors.y &= std::equal(row.begin(), row.end(), other.begin(), other.end(), equal);
    mirrors.point &= std::equal(row.begin(), row.end(), other.rbegin(), other.rend(), opposite);
  }
  return mirrors;
}

Kernel kernel_from_shares(int rx, int ry, const std::vector<std::int32_t>& values) {
  const Shares shares{rx, ry, values};
  Kernel kernel;
  trim(shares, kernel);

  const std::vector<Level> levels = distinct_shares(values);
  assert(levels.size() > 1 && levels.size() <= 256);
  kernel.levels = weights(levels);
  std::int32_t last_share = 0;
  std::uint8_t last_level = 0;
  const auto level_of = [&](std::int32_t share) {
    if (share != last_share) {
      const auto found = std::lower_bound(levels.begin(), levels.end(), share,
                                          [](const Level& level, std::int32_t s) { return level.share < s; });
      last_share = share;
      last_level = static_cast<std::uint8_t>(found - levels.begin());
    }
    return last_level;
  };

  kernel.row_begin.push_back(0);
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    std::uint8_t level = 0;
    for (int dx = -kernel.radius_x; dx <= kernel.radius_x + 1; ++dx) {
      const std::uint8_t next = level_of(shares.at(dx, dy));
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
