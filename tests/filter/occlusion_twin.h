// The plain twin of scatter with occlusion bitmaps, written for reading.
#pragma once

#include "filter/incremental_filter.h"

namespace pullfocus::test {

// What the accumulators must hold: exact_sums() without what a source gives to pixels that hide it. `keys` are the
// depth keys of the committed state, row by row.
std::vector<Accumulator> exact_sums_with_bitmaps(const SourceState& state, const std::vector<std::uint16_t>& keys,
                                                 const KernelTable& kernels, const VisibilityOptions& visibility,
                                                 int lanes);

std::vector<std::uint16_t> committed_keys(const IncrementalFilter& filter);

}  // namespace pullfocus::test
