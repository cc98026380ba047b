// All kernels of a run: one per signed CoC index.
#pragma once

#include <atomic>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "scatter/block_plan.h"
#include "scatter/coc_table.h"
#include "scatter/edge_plan.h"
#include "scatter/kernel.h"
#include "scatter/kernel_shape.h"

namespace pullfocus {

struct KernelOptions {
  double coc_step = 1. / 32;   // share of the diameter between table entries, at least half a pixel; [0, 1]
  double max_coc_px = 400;     // largest diameter, [1, 500]
  double pixel_aspect = 1;     // pixel width / height, (0.1, 10)
  float max_radiance = 65504;  // colours are clamped to +- this; the accumulators must hold it
  KernelShape shape{};         // intensity distribution
  double smallest_step = 0.5;  // pixels between table diameters at least, [1/8, 1/2]
};

class KernelTable {
 public:
  // Throws Error(usage) if the options are out of range, or if a sum could overflow int64: with B the sum
  // over all offsets of the largest weight any index has there, B * (max_radiance + 1) must stay below 2^63. Weights
  // count at their mirror images too, so that the bound holds whichever way a kernel is turned or folded.
  explicit KernelTable(const KernelOptions& options);

  const CocTable& coc() const noexcept { return coc_; }
  const KernelOptions& options() const noexcept { return options_; }
  // > 0 is behind focus and shows the aperture upright, < 0 in front of it and shows it turned by half a turn.
  const Kernel& kernel(int signed_index) const noexcept {
    const bool front = signed_index < 0 && !in_front_.empty();
    return (front ? in_front_ : kernels_)[static_cast<std::size_t>(signed_index < 0 ? -signed_index : signed_index)];
  }
  const EdgePlan& plan(int signed_index) const noexcept {
    const bool front = signed_index < 0 && !in_front_.empty();
    return (front ? plans_in_front_ : plans_)[static_cast<std::size_t>(std::abs(signed_index))];
  }
  // For going from one index to another that is at most kFarthestMove away. Made when first asked for, from any thread.
  static constexpr int kFarthestMove = 4;
  std::span<const EdgePlan> move(int from, int to) const;
  // Of whole blocks. Made when asked for often enough to be worth it, from any thread; until then, and where rows are
  // written faster one by one, empty. When asked for much more often, with common sums, which take longer to find.
  static constexpr int kAskedForBlock = 32, kAskedForSums = 512;
  const BlockPlan& block(int signed_index) const;
  const BlockPlan& block_move(int from, int to) const;
  std::span<const int> edge_counts() const noexcept { return edges_; }  // by |index|, and a 0 after the last
  bool symmetric() const noexcept { return symmetric_; }  // every kernel is its own mirror image in x and in y
  // Pixels that a flat kernel of the same spread would cover: 1 / sum of squared weights; >= 1.
  double area(int signed_index) const noexcept { return areas_[static_cast<std::size_t>(std::abs(signed_index))]; }
  double overlap_bound() const noexcept { return overlap_bound_; }  // B in units

 private:
  KernelOptions options_;
  CocTable coc_;
  std::vector<Kernel> kernels_;
  std::vector<Kernel> in_front_;  // empty if every kernel is its own reflection
  bool symmetric_ = true;
  std::vector<EdgePlan> plans_, plans_in_front_;
  struct Block {
    std::atomic<int> asked = 0;
    std::once_flag once, once_with_sums;
    std::unique_ptr<const BlockPlan> plan, with_sums;
  };
  static const BlockPlan& block_at(Block& block, std::span<const EdgePlan> edges);
  struct Move {
    std::once_flag once;
    std::unique_ptr<const std::vector<EdgePlan>> plans;
    Block block;
  };
  Move& move_at(int from, int to) const noexcept {
    return moves_[static_cast<std::size_t>((from + coc_.size() - 1) * (2 * kFarthestMove + 1) + to - from +
                                           kFarthestMove)];
  }
  mutable std::vector<Move> moves_;    // by signed index, then by where to
  mutable std::vector<Block> blocks_;  // by signed index
  std::vector<double> areas_;          // by |index|
  std::vector<int> edges_;             // by |index|: a reflection has as many; and a 0
  double overlap_bound_ = 0;
};

}  // namespace pullfocus
