#include "importance/remembered_depths.h"

#include <algorithm>

namespace pullfocus {

void RememberedDepths::reset(const TileGrid& grid) {
  if (grid.width != grid_.width || grid.height != grid_.height) {
    depth_ = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(grid.width) *
                                                     static_cast<std::size_t>(grid.height));
  }
  grid_ = grid;
  segments_.assign(static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.height), {});
  forget();
}

void RememberedDepths::begin(const CocFunction& coc) noexcept {
  steady_ = coc == coc_;
  if (steady_) return;
  coc_ = coc;
  forget();
}

void RememberedDepths::forget() noexcept {
  ++lens_;
  steady_ = false;
}

void RememberedDepths::take(std::span<const float> depths, int x, int y, const SegmentDifference& difference,
                            const SegmentFindings& findings) noexcept {
  Segment& segment = segments_[position(x, y)];
  if (difference.index != 0) {  // other indices may be committed
    segment.lens = 0;
    return;
  }
  // What moves is not worth remembering, nor is anything during a focus pull.
  if (!steady_ || difference.colour != 0 || findings.suspect) return;
  std::copy(depths.begin(), depths.end(), depth(x, y));
  segment = {lens_, static_cast<std::int16_t>(findings.largest), static_cast<std::int16_t>(findings.clamped)};
}

}  // namespace pullfocus
