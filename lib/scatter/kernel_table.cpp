#include "scatter/kernel_table.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "image/error.h"
#include "scatter/aperture_image.h"
#include "scatter/diffraction.h"
#include "scatter/disc.h"
#include "scatter/gaussian.h"
#include "scatter/polygon.h"

namespace pullfocus {

namespace {

using KernelOfDiameter = std::function<Kernel(double diameter_px)>;

KernelOfDiameter kernel_of_diameter(const KernelShape& shape, double aspect) {
  switch (shape.kind) {
    case KernelShape::Kind::polygon:
      return [=](double d) { return polygon_kernel(d, aspect, shape); };
    case KernelShape::Kind::gaussian:
      return [=](double d) { return gaussian_kernel(d, aspect); };
    case KernelShape::Kind::diffraction:
      return [=, profile = DiffractionProfile()](double d) { return diffraction_kernel(d, aspect, profile); };
    case KernelShape::Kind::image:
      return [=, image = ApertureImage(*shape.picture)](double d) { return image.kernel(d, aspect); };
    case KernelShape::Kind::disc:
      break;
  }
  return [=](double d) { return disc_kernel(d, aspect); };
}

// Sum over offsets of the largest weight of any kernel there, or at its mirror images, in units.
double largest_overlap(const std::vector<Kernel>& kernels) {
  int rx = 0, ry = 0;
  for (const Kernel& kernel : kernels) {
    rx = std::max(rx, kernel.radius_x);
    ry = std::max(ry, kernel.radius_y);
  }
  const int columns = 2 * rx + 1;
  std::vector<std::int64_t> largest(static_cast<std::size_t>(columns * (2 * ry + 1)));
  for (const Kernel& kernel : kernels) {
    for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
      std::int64_t* row = &largest[static_cast<std::size_t>((dy + ry) * columns + rx)];
      const auto edges = kernel.row(dy);
      for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
        const std::int64_t weight = kernel.levels[kernel.level_behind(edges[e])];
        for (int dx = edges[e].dx; dx < edges[e + 1].dx; ++dx) row[dx] = std::max(row[dx], weight);
      }
    }
  }
  double sum = 0;
  for (std::size_t y = 0, rows = static_cast<std::size_t>(2 * ry + 1); y < rows; ++y) {
    const std::int64_t* const row = &largest[y * static_cast<std::size_t>(columns)];
    const std::int64_t* const other = &largest[(rows - 1 - y) * static_cast<std::size_t>(columns)];
    for (int x = 0; x < columns; ++x) {
      sum += static_cast<double>(std::max({row[x], row[columns - 1 - x], other[x], other[columns - 1 - x]}));
    }
  }
  return sum / static_cast<double>(kWeightUnit);
}

double area_of(const Kernel& kernel) {
  double squares = 0;
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    const auto edges = kernel.row(dy);
    for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
      const double weight =
          static_cast<double>(kernel.levels[kernel.level_behind(edges[e])]) / static_cast<double>(kWeightUnit);
      squares += weight * weight * (edges[e + 1].dx - edges[e].dx);
    }
  }
  return 1 / squares;
}

}  // namespace

KernelTable::KernelTable(const KernelOptions& options)
    : options_(options), coc_(options.coc_step, options.max_coc_px, options.smallest_step) {
  if (!(options.pixel_aspect > 0.1 && options.pixel_aspect < 10)) {
    throw Error(ErrorCode::usage, fmt::format("pixel aspect ratio {} is not between 0.1 and 10: correct the "
                                              "file's pixelAspectRatio attribute",
                                              options.pixel_aspect));
  }
  if (!(options.max_radiance > 0)) {
    throw Error(ErrorCode::usage, "--max-radiance must be greater than 0");
  }
  validate(options.shape);
  kernels_.resize(static_cast<std::size_t>(coc_.size()));
  const KernelOfDiameter make = kernel_of_diameter(options.shape, options.pixel_aspect);
  plans_.resize(kernels_.size());
  tbb::parallel_for(
      std::size_t{0}, kernels_.size(),
      [&](std::size_t i) {
        kernels_[i] = make(coc_.diameter(static_cast<int>(i)));
        plans_[i] = plan_of(kernels_[i]);
      },
      tbb::simple_partitioner());
  bool point_symmetric = true;
  for (const Kernel& kernel : kernels_) {
    const Mirrors mirrors = mirrors_of(kernel);
    symmetric_ &= mirrors.x && mirrors.y;
    point_symmetric &= mirrors.point;
  }
  if (!point_symmetric) {
    for (const Kernel& kernel : kernels_) {
      in_front_.push_back(reflected(kernel));
      plans_in_front_.push_back(plan_of(in_front_.back()));
    }
  }
  moves_ = std::vector<Move>(static_cast<std::size_t>((2 * coc_.size() - 1) * (2 * kFarthestMove + 1)));
  blocks_ = std::vector<Block>(static_cast<std::size_t>(2 * coc_.size() - 1));
  for (const Kernel& kernel : kernels_) {
    areas_.push_back(area_of(kernel));
    edges_.push_back(kernel.edge_count());
  }
  edges_.push_back(0);
  overlap_bound_ = largest_overlap(kernels_);
  const double limit = std::ldexp(1.0, 23) / overlap_bound_ - 1;
  if (static_cast<double>(options.max_radiance) > limit) {
    throw Error(ErrorCode::usage, fmt::format("--max-radiance {} could overflow the 64-bit sums with kernels up "
                                              "to {} px: use at most {:.0f}, or a smaller --max-coc",
                                              options.max_radiance, options.max_coc_px, std::floor(limit)));
  }
}

std::span<const EdgePlan> KernelTable::move(int from, int to) const {
  Move& move = move_at(from, to);
  std::call_once(move.once, [&] {
    move.plans = std::make_unique<const std::vector<EdgePlan>>(plans_of_move(kernel(from), kernel(to)));
  });
  return *move.plans;
}

// Making a plan takes about as long as some 30 blocks save, and finding common sums as long as these save in some 600.
const BlockPlan& KernelTable::block_at(Block& block, std::span<const EdgePlan> edges) {
  static const BlockPlan none;
  const int asked = block.asked.load(std::memory_order_relaxed);
  if (asked < kAskedForSums) block.asked.fetch_add(1, std::memory_order_relaxed);
  if (asked < kAskedForBlock || edges.size() != 1) return none;
  const bool with_sums = asked >= kAskedForSums;
  auto& plan = with_sums ? block.with_sums : block.plan;
  std::call_once(with_sums ? block.once_with_sums : block.once, [&] {
    plan =
        std::make_unique<const BlockPlan>(block_plan_of(edges[0], with_sums ? CommonSums::found : CommonSums::ignored));
  });
  return *plan;
}

const BlockPlan& KernelTable::block(int signed_index) const {
  const int index = in_front_.empty() ? std::abs(signed_index) : signed_index;
  return block_at(blocks_[static_cast<std::size_t>(index + coc_.size() - 1)], {&plan(signed_index), 1});
}

const BlockPlan& KernelTable::block_move(int from, int to) const {
  const std::span<const EdgePlan> edges = move(from, to);
  return block_at(move_at(from, to).block, edges);
}

}  // namespace pullfocus
