// What the filter is held against in the hard cases: the same kernels, summed in float32 and summed without error.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "filter/incremental_filter.h"

namespace pullfocus::test {

// Every kernel of a table as a plain list of weights, with reflection at the borders of an image.
class Footprints {
 public:
  Footprints(const Window& window, std::shared_ptr<const KernelTable> kernels);

  const KernelTable& kernels() const { return *kernels_; }
  int width() const { return width_; }
  int height() const { return height_; }

  // Calls visit(target pixel, row by row, weight) for everything a source at (x, y), from the corner, reaches. A pixel
  // that several reflections reach is visited once for each.
  template <typename Visit>
  void for_each_target(int index, int x, int y, Visit&& visit) {
    for (const Part& part : parts(index)) {
      const int row = rows_[static_cast<std::size_t>(y + part.dy + reach_)];
      const int column = columns_[static_cast<std::size_t>(x + part.dx + reach_)];
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column),
            part.weight);
    }
  }

  // Signed table index of a depth.
  int index_of(const CocFunction& coc, float depth) const;

 private:
  struct Part {
    int dx, dy;
    std::int64_t weight;
  };
  const std::vector<Part>& parts(int index);

  std::shared_ptr<const KernelTable> kernels_;
  int width_, height_, reach_ = 0;
  std::vector<int> rows_, columns_;  // reflected, from -reach_ on
  std::map<int, std::vector<Part>> parts_;
};

// The incremental filter as one would write it with float32 sums: the old contribution of a changed pixel is
// subtracted, the new one added. Colours are taken as they come, unrepaired.
class FloatTwin {
 public:
  FloatTwin(const Window& window, std::shared_ptr<const KernelTable> kernels);

  void filter(const Frame& frame, const CocFunction& coc);
  const std::vector<float>& sums() const { return sums_; }  // R, G, B, weight, A
  std::vector<float> picture() const;                       // R, G, B, A

 private:
  struct Source {
    float rgba[4];
    int index;
  };
  void add(std::size_t pixel, const Source& source, float sign);

  Footprints footprints_;
  std::vector<Source> committed_;
  bool first_ = true;
  std::vector<float> sums_;
};

// The linear filter's picture in long double, from sanitised colours, and how far from it a picture of float32 samples
// may be whose sums hold round(I * w) for every contribution: half a unit for each, and half a unit in the last place.
struct TruePicture {
  std::vector<long double> rgba, bound;
};
TruePicture true_picture(const Frame& frame, const CocFunction& coc, Footprints& footprints);

// What the accumulators must hold, in integers that no sum overflows: 5 lanes a pixel.
using WideSum = __int128;
std::vector<WideSum> wide_sums(const SourceState& state, Footprints& footprints);

// The filter's sums with 5 lanes a pixel, alpha's being those of the weight where it keeps none.
std::vector<Accumulator> sums_with_alpha(const IncrementalFilter& filter);

// The sums, as signed numbers, are these.
bool holds(const IncrementalFilter& filter, const std::vector<WideSum>& expected);

}  // namespace pullfocus::test
