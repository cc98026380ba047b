// What the filters share: tables, threads, and the way from a frame of any type to one of the state's type.
#pragma once

#include <tbb/task_arena.h>

#include <chrono>
#include <memory>
#include <optional>

#include "filter/filter.h"
#include "importance/change.h"
#include "resolve/backdrop.h"
#include "scatter/occlusion.h"
#include "scatter/scatter.h"

namespace pullfocus {

class Stopwatch {
 public:
  double ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct FilterCore {
  // `table` must have been built from options.kernel, or be null. Throws Error(usage).
  FilterCore(const Window& state_window, const FilterOptions& filter_options, std::shared_ptr<const KernelTable> table);

  // Throws Error(usage) if the frame has another window.
  void check(const Frame& frame) const;

  // Throws Error(usage), and changes nothing then.
  void set_budget(const Budget& budget);

  // State window the content of a frame can reach.
  Window reached(const FrameFindings& findings) const noexcept;

  // Null if nothing hides anything.
  const Occlusion* hidden() const noexcept { return occlusion ? &*occlusion : nullptr; }
  // Null if no layer lies in front of others.
  Backdrop* behind() noexcept { return backdrop ? &*backdrop : nullptr; }

  static void report(const FrameFindings& findings, Stats& stats) noexcept;

  Window window;
  FilterOptions options;
  int threads;
  std::shared_ptr<const KernelTable> kernels;
  Sanitiser sanitiser;
  tbb::task_arena arena;
  Scatter scatter;
  Layers layers;                       // a single one without visibility
  std::optional<Occlusion> occlusion;  // with VisibilityOptions::Kind::bitmap
  std::optional<Backdrop> backdrop;    // of the result, with layers in front of focus and behind them
};

// Same values, stored as floats.
void widen(const ColourImage& half, ColourImage& out);

}  // namespace pullfocus
