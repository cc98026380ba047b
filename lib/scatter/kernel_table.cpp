#include "scatter/kernel_table.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "image/error.h"
#include "scatter/disc.h"

namespace pullfocus {

namespace {

// Sum over offsets of the largest weight of any kernel there, in units.
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
  for (const std::int64_t weight : largest) sum += static_cast<double>(weight);
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

KernelTable::KernelTable(const KernelOptions& options) : options_(options), coc_(options.coc_step, options.max_coc_px, options.smallest_step) {
  if (!(options.pixel_aspect > 0.1 && options.pixel_aspect < 10)) {
    throw Error(ErrorCode::usage, fmt::format("pixel aspect ratio {} is not between 0.1 and 10: correct the "
                                              "file's pixelAspectRatio attribute",
                                              options.pixel_aspect));
  }
  if (!(options.max_radiance > 0)) {
    throw Error(ErrorCode::usage, "--max-radiance must be greater than 0");
  }
  kernels_.resize(static_cast<std::size_t>(coc_.size()));
  tbb::parallel_for(0, coc_.size(), [&](int i) {
    kernels_[static_cast<std::size_t>(i)] = disc_kernel(coc_.diameter(i), options.pixel_aspect);
  });
  for (const Kernel& kernel : kernels_) areas_.push_back(area_of(kernel));
  overlap_bound_ = largest_overlap(kernels_);
  const double limit = std::ldexp(1.0, 23) / overlap_bound_ - 1;
  if (static_cast<double>(options.max_radiance) > limit) {
    throw Error(ErrorCode::usage, fmt::format("--max-radiance {} could overflow the 64-bit sums with kernels up "
                                              "to {} px: use at most {:.0f}, or a smaller --max-coc",
                                              options.max_radiance, options.max_coc_px, std::floor(limit)));
  }
}

}  // namespace pullfocus
