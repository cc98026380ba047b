// The naive scatter: tables of weights, every pixel of every kernel, no runs. The yardstick for speed, in float (as
// accurate as float sums are) and in double (as accurate as the filter). Kernels are the filter's own; those of
// --kernel polygon and image are not turned in front of focus. What leaves the image is dropped where the filter brings
// it back, which only makes it faster: pixels farther from the border than the largest kernel agree with LinearFilter.
#pragma once

#include <vector>

#include "bench/naive_scatter.h"
#include "camera/thin_lens.h"
#include "image/frame.h"
#include "scatter/kernel_table.h"

namespace pullfocus::cli::bench {

template <typename Real>
class NaiveFilter {
 public:
  // `kernels` must outlive this.
  NaiveFilter(const KernelTable& kernels, Way way);

  // RGBA over the frame's window, row by row, A = 1; of a frame without NaN or infinities. Destination bands in
  // parallel, in the calling task arena.
  const std::vector<Real>& filter(const Frame& frame, const CocFunction& coc);

 private:
  void read(const Frame& frame, const CocFunction& coc);
  void divide(const NaiveBand<Real>& band, int width);

  const KernelTable& kernels_;
  const Way way_;
  std::vector<NaiveKernel<Real>> tables_;  // by |index|
  std::vector<Real> colour_, result_;      // 4 values a pixel
  Aligned<Real> sums_;
  std::vector<std::int16_t> index_;
  int reach_x_ = 0, reach_y_ = 0;  // of the frame's largest kernels
};

}  // namespace pullfocus::cli::bench
