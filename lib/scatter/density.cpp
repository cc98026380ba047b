#include "scatter/density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pullfocus {

namespace {

bool few_values(const std::vector<std::int32_t>& values, std::int32_t from, int most) {
  std::vector<std::int32_t> seen;
  for (const std::int32_t value : values) {
    if (value < from) continue;
    const auto found = std::lower_bound(seen.begin(), seen.end(), value);
    if (found != seen.end() && *found == value) continue;
    if (static_cast<int>(seen.size()) == most) return false;
    seen.insert(found, value);
  }
  return true;
}

std::vector<std::int32_t> quantise(const Density& density, const std::vector<std::int32_t>& begin) {
  std::vector<std::int32_t> values = density.values();
  const std::int32_t peak = *std::max_element(values.begin(), values.end());
  if (few_values(values, begin[0], static_cast<int>(begin.size()))) {
    for (std::int32_t& value : values) value = value < begin[0] ? 0 : value;
    return values;
  }
  std::vector<std::uint8_t> level_of(static_cast<std::size_t>(peak) + 1);
  for (std::size_t k = 0; k < begin.size(); ++k) {
    for (auto value = static_cast<std::size_t>(begin[k]); value < level_of.size(); ++value) {
      level_of[value] = static_cast<std::uint8_t>(k + 1);
    }
  }
  std::vector<std::int64_t> sum(begin.size() + 1), count(begin.size() + 1);
  for (const std::int32_t value : values) {
    const std::uint8_t level = level_of[static_cast<std::size_t>(value)];
    sum[level] += value;
    ++count[level];
  }
  std::vector<std::int32_t> mean(begin.size() + 1);
  for (std::size_t k = 1; k < mean.size(); ++k) {
    if (count[k] > 0) mean[k] = static_cast<std::int32_t>((sum[k] + count[k] / 2) / count[k]);
  }
  for (std::int32_t& value : values) value = mean[level_of[static_cast<std::size_t>(value)]];
  return values;
}

// In 1024ths, exact for multiples of 1/16 px.
void mix_with_identity(std::vector<std::int32_t>& shares, double diameter) {
  constexpr std::int64_t largest_sum = 1 << 20;  // times 1024 fits
  const auto sum_of = [&] { return std::accumulate(shares.begin(), shares.end(), std::int64_t{0}); };
  while (sum_of() > largest_sum) {
    for (std::int32_t& share : shares) share = (share + 1) / 2;
  }
  const auto sum = static_cast<std::int32_t>(sum_of());
  const auto mixed = static_cast<std::int32_t>(diameter * diameter / (kMixBelow * kMixBelow) * 1024);
  for (std::int32_t& share : shares) share *= mixed;
  shares[shares.size() / 2] += sum * (1024 - mixed);
}

}  // namespace

Density::Density(double half_width, double half_height)
    : rx_(static_cast<int>(std::ceil(half_width + 0.5))),
      ry_(static_cast<int>(std::ceil(half_height + 0.5))),
      values_(static_cast<std::size_t>(2 * rx_ + 1) * static_cast<std::size_t>(2 * ry_ + 1)) {}

std::vector<std::int32_t> level_borders(const Density& density, int levels, Spacing spacing) {
  const std::int32_t peak = *std::max_element(density.values().begin(), density.values().end());
  std::vector<std::int32_t> borders;
  for (int k = 1; k <= levels; ++k) {
    const double share = (k - 0.5) / levels;
    const double border = spacing == Spacing::even ? share : share * std::sqrt(share);
    borders.push_back(std::max(1, static_cast<std::int32_t>(std::ceil(border * peak))));
  }
  return borders;
}

Kernel kernel_from_density(const Density& density, const std::vector<std::int32_t>& borders, double diameter_px) {
  const auto& values = density.values();
  const auto outside = [&](std::int32_t value) { return value < borders[0]; };
  if (diameter_px <= 0 || std::all_of(values.begin(), values.end(), outside)) return kernel_from_shares(0, 0, {1});
  std::vector<std::int32_t> shares = quantise(density, borders);
  if (diameter_px < kMixBelow) mix_with_identity(shares, diameter_px);
  return kernel_from_shares(density.rx(), density.ry(), shares);
}

}  // namespace pullfocus
