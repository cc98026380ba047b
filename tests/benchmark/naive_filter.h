// The naive scatter: tables of weights, every pixel of every kernel, no runs. The yardstick for speed, in double (as
// accurate as the filter) and in float (one SIMD operation a pixel, as accurate as float sums are). What leaves the
// image is dropped, which only makes it faster.
#pragma once

#include <vector>

#include "camera/thin_lens.h"
#include "image/frame.h"
#include "scatter/kernel_table.h"

namespace pullfocus::test {

template <typename Real>
class NaiveFilter {
 public:
  explicit NaiveFilter(const KernelTable& kernels);

  // RGBA over the frame's window, row by row. Destination bands in parallel, in the calling task arena.
  const std::vector<Real>& filter(const Frame& frame, const CocFunction& coc);

 private:
  struct Table {
    int rx, ry;
    std::vector<Real> weights;  // (2 ry + 1) rows of 2 rx + 1
  };
  const KernelTable& kernels_;
  std::vector<Table> tables_;
  std::vector<Real> colour_, sums_, result_;  // 4 values a pixel; sums: R, G, B, weight
  std::vector<std::int16_t> index_;
};

}  // namespace pullfocus::test
