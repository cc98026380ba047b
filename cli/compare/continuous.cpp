#include "compare/continuous.h"

#include <algorithm>
#include <cmath>

#include "camera/depth.h"

namespace pullfocus::cli {

namespace {

// Of a frame, in pixels; what is no number counts as background.
double largest_diameter(const Frame& frame, const CocFunction& coc) {
  const Window& w = frame.window();
  float largest = std::fabs(coc.background());
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = 0; x < w.width(); ++x) {
      const float depth = frame.depth.row(y)[x];
      if (!is_background(coc.kind, depth)) largest = std::max(largest, std::fabs(coc(depth)));
    }
  }
  return static_cast<double>(largest);
}

}  // namespace

ContinuousFilter::ContinuousFilter(std::string kernel, std::string visibility, const Window& state_window,
                                   const FilterOptions& options)
    : kernel_(std::move(kernel)),
      visibility_(std::move(visibility)),
      window_(state_window),
      options_(options),
      largest_(options.kernel.max_coc_px) {
  options_.kernel.coc_step = 0;
  options_.kernel.smallest_step = 1. / 8;
}

const ColourImage& ContinuousFilter::filter(const Frame& frame, const CocFunction& coc) {
  const double needed = std::min(largest_, largest_diameter(frame, coc) + 1);
  if (!filter_ || needed > options_.kernel.max_coc_px) {
    options_.kernel.max_coc_px = std::min(largest_, std::ceil(1.25 * needed));
    filter_ = make_linear_filter(window_, options_);
  }
  filter_->filter(frame, coc);
  return filter_->result();
}

}  // namespace pullfocus::cli
