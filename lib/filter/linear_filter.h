// The linear filter: Potmesil and Chakravarty's scatter of every pixel, every frame. No history, no budget.
#pragma once

#include "filter/core.h"

namespace pullfocus {

class LinearFilter final : public Filter {
 public:
  LinearFilter(const Window& state_window, const FilterOptions& options,
               std::shared_ptr<const KernelTable> kernels = nullptr);

  // `stop` is not asked: a linear frame is all or nothing.
  const Stats& filter(const Frame& frame, const CocFunction& coc, const StopRequest& stop = {}) override;
  const Stats& refine(const StopRequest& stop = {}) override;
  const ColourImage& result() const noexcept override { return result_; }
  const Window& result_window() const noexcept override { return result_window_; }
  LeftOver left_over() override { return {}; }
  void left_over_importance(Plane& out) override { out.reset(core_.window, 0); }
  void set_budget(const Budget& budget) override { core_.set_budget(budget); }
  void reset() override {}

 private:
  FilterCore core_;
  SourceState state_;  // this frame, sanitised
  std::vector<TileWork> tiles_;
  ColourImage result_;
  Window result_window_;
  Stats stats_;
};

}  // namespace pullfocus
