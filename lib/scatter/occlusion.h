// Occlusion bitmaps (Fearing 1996, section 5), exact under change.
//
// P gives nothing to U if, by the committed state of both, P lies behind U (its depth key is strictly larger), their
// CoC diameters differ by more than K pixels, and U - P lies in the window of L x L offsets, -L/2 .. L/2 - 1 each way.
// Bit U of P's bitmap is this relation. Beyond the borders the picture goes on mirrored: an offset that crosses one
// meets the mirror image of U. Farther away than the window nothing is hidden.
//
// Held-out pixels (Frame::mask) have the background's key and size 0, whatever their depth: they hide nothing, and as
// they give nothing they are hidden from nothing either. What falls on them stays in their sums, unseen.
//
// No bitmap is stored: the relation is a function of the committed state, so that the bitmap a contribution was made
// with is computed again, from two 16-bit planes, when the contribution is taken back. So none can go stale, and the
// memory is 4 bytes a pixel instead of L * L / 8.
//
//   sums = plain scatter - what the bitmaps hide
//
// Plain scatter goes on as ever, in groups of sources; of what is hidden only the runs are written, which costs a
// compare of up to L pixels for each kernel row of a source and edges where something is hidden. Cells of 16 x 16
// pixels in which their bounds of depth and size tell that nothing can be hidden are left out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/frame.h"
#include "scatter/depth_key.h"
#include "scatter/depth_planes.h"
#include "scatter/kernel_table.h"
#include "scatter/occluded_edges.h"
#include "scatter/state.h"
#include "scatter/visibility.h"

namespace pullfocus {

inline std::uint16_t key_unless_held_out(std::uint16_t key, std::int16_t index) noexcept {
  return index == kHeldOut ? kBackgroundKey : key;
}

// The depths that a committed state was made from, and what they tell of who may hide whom. Reading is safe from any
// number of threads; take() is not.
class Occlusion {
 public:
  // `kernels` must outlive this. Size of the state window in pixels.
  Occlusion(const VisibilityOptions& options, const KernelTable& kernels, int width, int height);

  void reset();

  // Takes over depth and CoC size of the pixels of `tiles`, which `state` holds already, `frame` being where they came
  // from. Runs in the calling task arena.
  void take(const Frame& frame, DepthKind kind, const SourceState& state, std::span<const TileWork> tiles);

  const VisibilityOptions& options() const noexcept { return options_; }
  const DepthPlanes& planes() const noexcept { return planes_; }
  NearSizes near(int size) const noexcept { return near_[static_cast<std::size_t>(size)]; }

  // Bit i: the depth key of pixel (x + i, y) is not the committed one; n depths and signed indices (null: none is held
  // out), 1 <= n <= kTileWidth.
  std::uint64_t changed_keys(DepthKind kind, const float* depth, const std::int16_t* index, int x, int y,
                             int n) const noexcept;

  // Columns of a tile in which a source may be hidden from a pixel.
  std::uint64_t columns(int tile) const noexcept { return columns_[static_cast<std::size_t>(tile)]; }
  // Whether a pixel at (x, y), of any of two keys and sizes, may hide anything that the state holds.
  bool may_hide(int x, int y, std::uint16_t key_a, std::uint16_t key_b, int size_a, int size_b) const noexcept;
  // Rows that the kernel of any source around (x, y) may reach up and down, at most L/2.
  int rows_around(int x, int y) const noexcept;

  // The pixels of `tiles` that need a bitmap, and of these the kernel rows to look at, at most.
  struct Need {
    std::int64_t pixels = 0, rows = 0;
  };
  Need need(std::span<const TileWork> tiles) const noexcept;
  Need need() const noexcept { return whole_need_; }  // of all tiles
  std::size_t bytes() const noexcept;
  std::vector<TileWork> needing(std::span<const TileWork> tiles) const;

 private:
  static constexpr int kCell = kCellWidth;  // columns; a tile's height
  static_assert(kTileHeight == kCell && kTileWidth % kCell == 0);
  struct Bounds {
    std::uint16_t key_min = 0xffff, key_max = 0, size_min = 0xffff, size_max = 0;
    void add(const Bounds& other) noexcept;
  };

  std::size_t cell(int cx, int cy) const noexcept {
    return static_cast<std::size_t>(cy) * static_cast<std::size_t>(cells_x_) + static_cast<std::size_t>(cx);
  }
  void take_row(const Frame& frame, DepthKind kind, const SourceState& state, const TileWork& work, int row) noexcept;
  Bounds bounds_of(int cx, int cy) const noexcept;
  void look_around(int cx, int cy) noexcept;
  std::int64_t rows_of(const Bounds& bounds) const noexcept;

  const VisibilityOptions options_;
  const KernelTable& kernels_;
  const TileGrid grid_;
  const int cells_x_, cells_y_, around_;  // cells; and how many of them a window reaches
  std::vector<NearSizes> near_;           // by |index|
  std::vector<int> reach_;                // rows or columns, the larger, of all kernels up to |index|
  DepthPlanes planes_;
  std::vector<Bounds> cells_, neighbourhoods_;
  std::vector<std::uint64_t> columns_;
  Need whole_need_;
};

}  // namespace pullfocus
