// Linear filters with CoC steps so fine that only 1/8 pixel is left of them: what quantisation is measured against.
#pragma once

#include <memory>
#include <string>

#include "filter/filter.h"

namespace pullfocus::cli {

class ContinuousFilter {
 public:
  // `kernel` and `visibility` as typed tell one from another.
  ContinuousFilter(std::string kernel, std::string visibility, const Window& state_window,
                   const FilterOptions& options);

  bool is(const std::string& kernel, const std::string& visibility) const noexcept {
    return kernel == kernel_ && visibility == visibility_;
  }
  // Valid until the next call. The table grows with the largest CoC met: in full it has 3200 kernels and takes seconds.
  const ColourImage& filter(const Frame& frame, const CocFunction& coc);
  const ColourImage& result() const noexcept { return filter_->result(); }

 private:
  std::string kernel_, visibility_;
  Window window_;
  FilterOptions options_;
  double largest_;  // --max-coc
  std::unique_ptr<Filter> filter_;
};

}  // namespace pullfocus::cli
