// Writing sources into a band as run edges, in groups of neighbours that share a kernel. SIMD with run-time dispatch;
// every target gives the same bits.
#pragma once

#include <cstdint>

#include "scatter/band.h"
#include "scatter/kernel_table.h"
#include "scatter/source_row.h"

namespace pullfocus {

// A band as kernels see it: kernel rows Y in [y0, y1) land on band row `first + (Y - y0) * direction`. The
// band itself, and its mirror images past the top and bottom border that kernels still reach. Light comes back from
// there as if the picture went on mirrored, every source with its kernel as it is: seen from the source, the kernel's
// rows run backwards where `direction` is -1.
struct BandImage {
  int y0, y1;
  int first, direction;

  int band_row(int y) const noexcept { return first + (y - y0) * direction; }
};

// Writes the sources of one tile row, row y, with their kernels into the band rows of one of its images.
template <int lanes>
using WriteRow = void (*)(const KernelTable& kernels, const SourceRow<lanes>& row, int y, const BandImage& image,
                          Band& band);

// For the processor at hand.
template <int lanes>
WriteRow<lanes> row_writer(RowKind kind) noexcept;

}  // namespace pullfocus
