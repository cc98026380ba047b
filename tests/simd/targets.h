// SIMD targets by name, and running code on one of them whatever the processor would choose.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pullfocus::test {

// Targets that were compiled in and that this processor has, best first.
std::vector<std::int64_t> simd_targets();
std::string simd_target_name(std::int64_t target);

// Dispatches to `target` alone for as long as it lives.
class OnTarget {
 public:
  explicit OnTarget(std::int64_t target);
  ~OnTarget();
  OnTarget(const OnTarget&) = delete;
  OnTarget& operator=(const OnTarget&) = delete;
};

}  // namespace pullfocus::test
