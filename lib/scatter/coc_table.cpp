#include "scatter/coc_table.h"

#include <algorithm>
#include <cstdlib>

#include "image/error.h"

namespace pullfocus {

namespace {

// Sixteenths of a pixel keep every diameter exact in binary, so that tables are the same on every machine.
double round_to_sixteenth(double value) { return std::round(value * 16) / 16; }

}  // namespace

CocTable::CocTable(double coc_step, double max_coc_px, double smallest_step) {
  if (!(coc_step >= 0 && coc_step <= 1)) {
    throw Error(ErrorCode::usage, "--coc-step must lie between 0 (half-pixel steps everywhere) and 1");
  }
  if (!(max_coc_px >= 1 && max_coc_px <= kMaxDiameter)) {
    throw Error(ErrorCode::usage, "--max-coc must lie between 1 and 500 pixels");
  }
  if (!(smallest_step >= 1. / 8 && smallest_step <= 1. / 2)) {
    throw Error(ErrorCode::usage, "the smallest step of CoC diameters must lie between 1/8 and 1/2 pixel");
  }
  const double largest = round_to_sixteenth(max_coc_px);
  max_diameter_ = static_cast<float>(largest);
  // A last step of a sixteenth would have no look-up cell of its own.
  for (double d = 0; d < largest - 1. / 16; d += round_to_sixteenth(std::max(smallest_step, coc_step * d))) {
    diameters_.push_back(d);
  }
  diameters_.push_back(largest);

  const auto cells = static_cast<std::size_t>(largest * kCellsPerPixel) + 1;
  cells_.resize(cells);
  std::size_t index = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double centre = (static_cast<double>(cell) + 0.5) / kCellsPerPixel;
    while (index + 1 < diameters_.size() && centre - diameters_[index] > diameters_[index + 1] - centre) ++index;
    cells_[cell] = static_cast<std::int32_t>(index);
  }
}

}  // namespace pullfocus
