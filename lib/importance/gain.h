// Order::gain (see order.h) of whole tile rows.
#pragma once

#include <vector>

#include "image/tiles.h"
#include "importance/gain_row.h"
#include "importance/order.h"
#include "importance/segment.h"

namespace pullfocus {

class Gain {
 public:
  Gain(const Pending& pending, const ColourMetric& metric);

  // Priorities of pixels x .. x + n - 1 (n <= kTileWidth) of row y, from the window's corner; what they are where
  // nothing has changed means nothing. Single precision, and the same bits everywhere: no operation is contracted.
  // Returns where only the kernel changes, bit i of pixel x + i.
  std::uint64_t row(int x, int y, int n, float* out) const noexcept;

 private:
  template <SampleType type>
  void load(const Pixel<type>* pixels, int n, PlanarRow& out) const noexcept;
  template <SampleType type>
  void load_rows(int x, int y, int n, PlanarRow& now, PlanarRow& then) const noexcept;

  const Pending& pending_;
  const ColourMetric& metric_;
  std::vector<float> areas_;  // 1 / A of a kernel's area A, by |index|
};

}  // namespace pullfocus
