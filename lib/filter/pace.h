// How fast this machine is at the moment, for deadlines.
#pragma once

#include <algorithm>
#include <cstdint>

#include "importance/slices.h"

namespace pullfocus {

// Estimates of work in milliseconds, corrected by every measurement. They decide where a call with a deadline ends,
// never what a sum holds.
class Pace {
 public:
  // Of work as SliceQueue counts it; and of a rebuild, which resolves too, by its edges: until one has been measured,
  // taken as slices that reach so many pixels.
  double scatter_ms(std::int64_t work) const noexcept { return scatter_.each * static_cast<double>(work); }
  double rebuild_ms(std::int64_t edges, std::int64_t pixels) const noexcept {
    return rebuild_.measured ? rebuild_.each * static_cast<double>(edges) : scatter_ms(edges + kReachedPixel * pixels);
  }
  double resolve_ms(std::int64_t pixels) const noexcept { return resolve_.each * static_cast<double>(pixels); }
  std::int64_t work_in(double ms) const noexcept {
    return static_cast<std::int64_t>(std::clamp(ms / scatter_.each, 1., 1e15));
  }

  void scattered(std::int64_t work, double ms) noexcept { scatter_.correct(work, ms); }
  void rebuilt(std::int64_t edges, double ms) noexcept { rebuild_.correct(edges, ms); }
  void resolved(std::int64_t pixels, double ms) noexcept { resolve_.correct(pixels, ms); }

 private:
  // Milliseconds of one unit: a guess for one slow core, then the first measurement, then what the last few say.
  struct Estimate {
    double each;
    bool measured = false;

    void correct(std::int64_t count, double ms) noexcept {
      if (count <= 0 || !(ms > 0)) return;
      const double found = std::clamp(ms / static_cast<double>(count), 1e-8, 1e-2);
      each = measured ? each + (found - each) / 4 : found;
      measured = true;
    }
  };

  Estimate scatter_{1e-6}, rebuild_{0}, resolve_{1e-5};
};

}  // namespace pullfocus
