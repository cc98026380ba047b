// Kernels as stacks of run shapes in the difference domain.
//
// A kernel spreads one source pixel over the pixels around it with non-negative integer weights that sum to
// one unit (2^40) within 1e-7 (up to 220000 pixels of one weight, which is all that square pixels allow). Its weights
// take few distinct values, the *levels*, and along a row the level changes at few places, the *edges*. A source
// writes, per edge, only the change of its contribution; one prefix sum per row turns changes into contributions. So a
// source costs O(radius) writes, not O(radius^2) (Fearing 1996, section 4.2, reformulated).
//
// The contribution of colour I at level k is round(I * levels[k]), a function of the source's own state
// alone: writing the same edges with the other sign takes it back to the last bit, in any order (Fearing,
// section 4.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pullfocus {

inline constexpr std::int64_t kWeightUnit = std::int64_t{1} << 40;

struct KernelStep {
  std::uint8_t low, high;  // levels on the two sides of an edge
};

struct KernelEdge {
  std::int16_t dx;    // first column, relative to the source, that has the new level
  std::uint8_t step;  // index into Kernel::steps
  bool rising;        // from low to high; else from high to low
};

// All pairs of 16 levels and the outside.
inline constexpr std::size_t kMaxKernelSteps = 17 * 16 / 2;

struct Kernel {
  int radius_x = 0, radius_y = 0;        // columns -radius_x..radius_x and rows -radius_y..radius_y hold all weight
  std::vector<std::int64_t> levels;      // ascending weights; levels[0] = 0 is outside
  std::vector<KernelStep> steps;         // distinct pairs of levels, at most kMaxKernelSteps
  std::vector<std::uint32_t> row_begin;  // edges of row dy are [row_begin[dy + radius_y], row_begin[.. + 1])
  std::vector<KernelEdge> edges;

  std::span<const KernelEdge> row(int dy) const noexcept {
    const auto r = static_cast<std::size_t>(dy + radius_y);
    return {edges.data() + row_begin[r], row_begin[r + 1] - row_begin[r]};
  }
  std::uint8_t level_behind(const KernelEdge& edge) const noexcept {
    return edge.rising ? steps[edge.step].high : steps[edge.step].low;
  }
  int edge_count() const noexcept { return static_cast<int>(edges.size()); }

  // Weight at an offset, in units of 1 / kWeightUnit; 0 outside. Slow: for tests and explanations.
  std::int64_t weight(int dx, int dy) const noexcept;
  std::int64_t total() const noexcept;
};

// Builds a kernel from integer shares >= 0, row by row: `shares[(dy + ry) * (2 * rx + 1) + dx + rx]`. A level's weight
// is within 1.5 counts of unit * share / sum of shares, and chosen so that all weights sum to the unit within half the
// pixels of the rarest level: relative error below 1e-7 where that has no more than 220000. Empty margins are trimmed.
// Needs at least one share > 0, at most 255 distinct ones that differ by more than 2^-38 of their sum, and offsets
// within +-32000. Throws std::logic_error for more than kMaxKernelSteps kinds of edges.
Kernel kernel_from_shares(int rx, int ry, const std::vector<std::int32_t>& shares);

// The kernel turned by half a turn about its source, with the same levels and steps.
Kernel reflected(const Kernel& kernel);

struct Mirrors {
  bool x, y, point;  // equal to its mirror image left to right, top to bottom, to its reflection in the source
};
Mirrors mirrors_of(const Kernel& kernel);

}  // namespace pullfocus
