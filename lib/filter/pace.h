// How fast this machine is at the moment, for deadlines.
#pragma once

#include <algorithm>
#include <cstdint>

namespace pullfocus {

// Estimates of work in milliseconds, corrected by every measurement. They decide where a call with a deadline ends,
// never what a sum holds.
class Pace {
 public:
  double scatter_ms(std::int64_t edges) const noexcept { return scatter_ * static_cast<double>(edges); }
  double resolve_ms(std::int64_t pixels) const noexcept { return resolve_ * static_cast<double>(pixels); }
  std::int64_t edges_in(double ms) const noexcept {
    return static_cast<std::int64_t>(std::clamp(ms / scatter_, 1., 1e15));
  }

  void scattered(std::int64_t edges, double ms) noexcept { correct(scatter_, edges, ms); }
  void resolved(std::int64_t pixels, double ms) noexcept { correct(resolve_, pixels, ms); }

 private:
  static void correct(double& ms_each, std::int64_t count, double ms) noexcept {
    if (count <= 0 || !(ms > 0)) return;
    ms_each += (std::clamp(ms / static_cast<double>(count), 1e-8, 1e-2) - ms_each) / 4;
  }

  double scatter_ = 2e-6, resolve_ = 1e-5;  // ms each, on one slow core, until measured
};

}  // namespace pullfocus
