// What the benchmarks share.
#pragma once

#include <algorithm>
#include <vector>

namespace pullfocus::test {

// The upper one of two in the middle; not of nothing.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace pullfocus::test
