// Scatter: sources into destination bands, as run edges, and the finished rows to whoever wants them.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "scatter/band.h"
#include "scatter/blocks.h"
#include "scatter/edges.h"
#include "scatter/kernel_table.h"
#include "scatter/source_row.h"
#include "scatter/tile_work.h"

namespace pullfocus {

// One finished row of one layer: sums at image columns within the spans, zeros at the others.
struct LayerRow {
  int layer;
  const Accumulator* values;  // at column 0
  std::span<const ColumnSpan> spans;
};

class Scatter {
 public:
  // `kernels` must outlive this. Size of the state window in pixels.
  Scatter(const KernelTable& kernels, int width, int height);

  // A span of one finished row: the sum of all given contributions to columns [x0, x1) of row y, `lanes`
  // accumulators a pixel. Rows come in any order and from several threads, the spans of one row from one
  // thread.
  using Take = std::function<void(int y, int x0, int x1, const Accumulator* values)>;

  // Scatters the masked pixels of `tiles` and hands over all spans they may reach. `lanes`: kOpaqueLanes or
  // kAlphaLanes. Runs in the calling task arena with up to `threads` bands at a time; the sums do not depend
  // on it.
  void run(std::span<const TileWork> tiles, const Sources& sources, int lanes, int threads, const Take& take);

  // The same for several layers, whose ranges replace that of `sources`. A row is handed over once, with the layers
  // that may be non-zero in it, in the order of `work`.
  using TakeRow = std::function<void(int y, std::span<const LayerRow> layers)>;
  void run(std::span<const LayerWork> work, const Sources& sources, int lanes, int threads, const TakeRow& take);

  // The largest radii of all kernels up to |index|.
  int reach_x(int index) const noexcept { return reach_x_[static_cast<std::size_t>(index)]; }
  int reach_y(int index) const noexcept { return reach_y_[static_cast<std::size_t>(index)]; }

 private:
  // The smallest |index| up to which some kernel reaches `rows` rows.
  int least_reaching(int rows) const noexcept {
    return static_cast<int>(std::lower_bound(reach_y_.begin(), reach_y_.end(), rows) - reach_y_.begin());
  }

  template <int lanes>
  using Lines = std::array<RowSources<lanes>, kBlockRows>;

  // What one thread works with.
  struct Scratch {
    std::vector<Band> bands;  // one a layer
    BlockValues values;
    std::unique_ptr<Lines<kOpaqueLanes>> opaque_lines;
    std::unique_ptr<Lines<kAlphaLanes>> alpha_lines;

    template <int lanes>
    Lines<lanes>& lines() {
      auto& lines = std::get<std::unique_ptr<Lines<lanes>>&>(std::tie(opaque_lines, alpha_lines));
      if (!lines) lines = std::make_unique_for_overwrite<Lines<lanes>>();
      return *lines;
    }
  };

  // A tile, and what every band asks of it.
  struct Placed {
    const TileWork* work;
    int x, y;               // of its corner
    int rx, ry;             // that its kernels reach
    TileMask::Bounds part;  // of its mask
  };
  std::vector<Placed> placed(const LayerWork& layer) const;  // in the layer's order
  static void fetch_lines(const Placed& tile, int first, const Sources& sources) noexcept;

  static constexpr int kReachOfColumns = 32;  // rows; measured, smaller kernels are no faster column by column

  template <int lanes>
  void fill(Band& band, std::span<const Placed> tiles, const Sources& sources, const BandLayout& layout,
            Scratch& scratch) const;

  template <int lanes>
  void write_lines(Band& band, const Placed& tile, int first, const Sources& sources, const BandImage& image, bool fold,
                   Scratch& scratch) const;

  template <int lanes, typename Write>
  void write_beyond(Band& band, const SourceRow<lanes>& row, RowKind kind, int y, int reach, const BandImage& image,
                    Write&& write) const;

  template <int lanes>
  void write_hidden(Band& band, const Sources& sources, int x, int y, std::uint64_t mask, int reach,
                    const BandImage& image, bool fold) const;

  const KernelTable& kernels_;
  const TileGrid grid_;
  std::vector<int> reach_x_, reach_y_;  // by |index|
  tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace pullfocus
