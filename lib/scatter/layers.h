// Layers: sources by their signed circle of confusion, nearest first. Borders are options, never content, so that a
// source's layer is a function of its own state alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scatter/coc_table.h"
#include "scatter/state.h"
#include "scatter/tile_work.h"

namespace pullfocus {

class Layers {
 public:
  static constexpr std::size_t kMostBorders = 15;

  // Signed CoC diameters in pixels, ascending; a diameter at a border belongs to the side nearer to focus. None: a
  // single layer. Throws Error(usage) naming --visibility.
  Layers(const CocTable& coc, std::span<const double> borders);

  int count() const noexcept { return static_cast<int>(ranges_.size()); }
  int near() const noexcept;  // layers, from the nearest on, whose sources are all in front of focus
  int of(int signed_index) const noexcept { return of_[static_cast<std::size_t>(signed_index + offset_)]; }

  struct Range {
    std::int16_t first, last;  // signed indices; empty if first > last
  };
  Range range(int layer) const noexcept { return ranges_[static_cast<std::size_t>(layer)]; }

 private:
  int offset_;
  std::vector<std::uint8_t> of_;  // by signed index
  std::vector<Range> ranges_;
};

// The sources of one layer.
struct LayerWork {
  int layer = 0;
  Layers::Range range{};
  std::vector<TileWork> tiles;
};

// Throws Error(usage) naming --visibility.
void validate_borders(std::span<const double> borders);

// Masked pixels by layer, nearest first; a pixel that changes its layer (from the committed index to the one in
// `pending`, row by row; null: the committed one only) is in both. Layers without any are left out. Runs in the calling
// task arena.
std::vector<LayerWork> by_layer(const std::vector<TileWork>& tiles, const Layers& layers, const SourceState& state,
                                const std::int16_t* pending);

}  // namespace pullfocus
