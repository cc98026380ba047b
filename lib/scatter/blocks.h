// Writing blocks of sources that share a kernel: several rows at once. SIMD with run-time dispatch; every target gives
// the same bits, and the same as writing the rows one by one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scatter/edges.h"
#include "simd/aligned.h"

namespace pullfocus {

// kBlockRows rows of one tile, all of one kind. Pixels not in `masks` are no sources; a row without any may hold
// anything.
template <int lanes>
struct SourceBlock {
  std::array<const SourceRow<lanes>*, kBlockRows> rows;
  std::array<std::uint64_t, kBlockRows> masks;
  int x, y;  // image column of column 0, image row of the first row
};

// Room for the value rows of a block. One thread's at a time.
class BlockValues {
 public:
  // `rows` rows of `size` values each, with `pad` zeros before, between and after them. Between any but the last ones,
  // nobody may change them.
  Accumulator* rows(std::size_t rows, std::size_t size, std::size_t pad) {
    if (size != size_) values_.clear();
    size_ = size;
    values_.resize(std::max(values_.size(), pad + rows * (size + pad)));
    return values_.data() + pad;
  }

 private:
  std::vector<Accumulator, CacheAligned<Accumulator>> values_;
  std::size_t size_ = 0;
};

inline constexpr int kFewestInBlock = 16;  // sources of a kernel that are worth a look

// Writes those sources that many of their neighbours share a kernel with, and leaves the others in `masks`: these are
// for row_writer.
template <int lanes>
using WriteBlocks = void (*)(const KernelTable& kernels, SourceBlock<lanes>& block, const BandImage& image, Band& band,
                             BlockValues& values);

// For the processor at hand.
template <int lanes>
WriteBlocks<lanes> block_writer(RowKind kind) noexcept;

}  // namespace pullfocus
