// Reading a row of pixels: depths to signed CoC indices, and what differs from the committed state. SIMD with run-time
// dispatch; every target gives the same bits.
#pragma once

#include <cstdint>

#include "camera/thin_lens.h"
#include "image/sane.h"
#include "image/tiles.h"
#include "scatter/coc_table.h"

namespace pullfocus {

// How one frame's depths become indices.
struct DepthToIndex {
  CocFunction coc;
  float max_diameter = 0;               // pixels; CocTable::max_diameter()
  const std::int32_t* cells = nullptr;  // CocTable::cells()
  bool scaled = false;                  // by artistic factors other than 1

  DepthToIndex(const CocFunction& function, const CocTable& table) noexcept
      : coc(function),
        max_diameter(table.max_diameter()),
        cells(table.cells()),
        scaled(function.artistic.in_front != 1 || function.artistic.behind != 1) {}
};

struct SegmentFindings {
  int clamped = 0;       // diameters beyond the largest
  int largest = 0;       // largest |index|
  bool suspect = false;  // false: is_suspect holds for none of the depths, whatever their alpha
};

// Writes the signed indices of n depths (1 <= n <= kTileWidth) to index[0 .. n - 1]: CocTable::index of the CoC, that
// of infinity for a planar background, 0 for one of kind coc.
SegmentFindings signed_indices(const DepthToIndex& to_index, const float* depth, int n, std::int16_t* index) noexcept;

// One row of a tile and what is committed there, n pixels each (1 <= n <= kTileWidth).
template <SampleType type>
struct SegmentPair {
  const float* depth;
  const Pixel<type>* colours;  // of the frame, as stored
  const Pixel<type>* old_colours;
  const std::int16_t* old_index;
  int n;
  const float* known_depth = nullptr;  // if not null: depths whose indices `old_index` holds
};

// Bit i: pixel i differs.
struct SegmentDifference {
  std::uint64_t index = 0;
  std::uint64_t colour = 0;  // by the stored bits, not yet sanitised
  bool known = false;        // all depths are `known_depth`, bit for bit
};

// Signed indices as above, and which of them, and of the colours, differ from the committed ones. `index` has room for
// kTileWidth values, whatever n. Where the depths are known nothing is written to it, and nothing found.
template <SampleType type>
SegmentFindings compare(const DepthToIndex& to_index, const SegmentPair<type>& pair, std::int16_t* index,
                        SegmentDifference& difference) noexcept;

// `count` whole rows of tiles side by side, the first of which is given, all depths known: how many from the left on
// have their known depths and their committed colours, bit for bit.
template <SampleType type>
int unchanged_segments(const SegmentPair<type>& first, int count) noexcept;

}  // namespace pullfocus
