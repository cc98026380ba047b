// Depths whose indices are known to be the committed ones: while they and the lens stay, none of them is turned into
// an index again.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "camera/thin_lens.h"
#include "image/tiles.h"
#include "importance/segment.h"

namespace pullfocus {

// Coordinates count from the state window's corner; x is the left column of a tile. Threads: one a row.
class RememberedDepths {
 public:
  // Nothing is known. Allocates 4 bytes a pixel, which are not touched before there is something to remember.
  void reset(const TileGrid& grid);

  // Before a frame is compared: forgets everything if `coc` is not what it was at the last call.
  void begin(const CocFunction& coc) noexcept;
  void forget() noexcept;

  // The depths of that row of a tile whose indices the committed ones are; null if they are not known.
  const float* known(int x, int y) const noexcept { return at(x, y).lens == lens_ ? depth(x, y) : nullptr; }
  // How many rows of tiles from there on, `most` at most, are known.
  int known_from(int x, int y, int most) const noexcept {
    const Segment* const segment = &at(x, y);
    int n = 0;
    while (n < most && segment[n].lens == lens_) ++n;
    return n;
  }
  // What was found in them when they became known.
  SegmentFindings findings(int x, int y) const noexcept { return {at(x, y).clamped, at(x, y).largest, false}; }

  // Depths that were not known as they are, and how they compare with the committed state.
  void take(std::span<const float> depths, int x, int y, const SegmentDifference& difference,
            const SegmentFindings& findings) noexcept;

 private:
  struct Segment {
    std::uint32_t lens = 0;  // that of the known depths
    std::int16_t largest = 0;
    std::int16_t clamped = 0;
  };

  float* depth(int x, int y) const noexcept {
    return &depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width) + static_cast<std::size_t>(x)];
  }
  std::size_t position(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.columns()) +
           static_cast<std::size_t>(x / kTileWidth);
  }
  const Segment& at(int x, int y) const noexcept { return segments_[position(x, y)]; }

  TileGrid grid_;
  std::unique_ptr<float[]> depth_;
  std::vector<Segment> segments_;
  CocFunction coc_;
  std::uint32_t lens_ = 1;  // grows whenever everything is forgotten
  bool steady_ = false;     // coc_ is that of the call before, too
};

}  // namespace pullfocus
