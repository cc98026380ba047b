// Change detection: which pixels of a frame differ from what was committed (DESIGN section 5, Fearing 1996,
// section 4.1).
#pragma once

#include <cstdint>
#include <vector>

#include "importance/edge_count.h"
#include "importance/importance.h"
#include "importance/ingest.h"
#include "scatter/kernel_table.h"
#include "scatter/occlusion.h"
#include "scatter/state.h"
#include "scatter/tile_work.h"

namespace pullfocus {

// What one frame would change of a committed state.
struct Changes {
  std::vector<TileWork> tiles;  // tiles with changed pixels, in grid order
  std::int64_t pixels = 0;
  bool opaque = true;  // every changed pixel has an alpha of exactly 1
  EdgeCount edges;     // of take_changes() only
  FrameFindings findings;
};

// Compares `frame` with `state` (same window and sample type), tile by tile. `pending` (one index per pixel,
// row by row) receives the new indices of the tile rows that hold changed pixels, and keeps its values
// elsewhere. Pixels whose change is within `thresholds` count as unchanged. With `occlusion` (which goes with the
// state; may be null) a pixel is changed too if its depth key is; that is within a threshold only if CoC has one, which
// depth is part of. `remembered` goes with the state and the frame's lens, and must be null for frames with a mask;
// with it depths that are known to have the committed indices are only compared. Threads: runs in the calling task
// arena; the result does not depend on their number.
Changes find_changes(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser,
                     const SourceState& state, const ChangeThresholds& thresholds, std::vector<std::int16_t>& pending,
                     const Occlusion* occlusion = nullptr, RememberedDepths* remembered = nullptr);

// The same, and takes all that it finds over into `state` on the way: one pass over the frame in place of three
// (find_changes(), count_edges() and commit()), for calls that will take every change over in any case.
// The tiles' `max_index` covers what is committed now, no longer what was before.
Changes take_changes(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, const Sanitiser& sanitiser,
                     SourceState& state, const ChangeThresholds& thresholds, const Occlusion* occlusion = nullptr,
                     RememberedDepths* remembered = nullptr);

// What a whole frame came to.
struct Committed {
  bool opaque = true;      // every pixel has an alpha of exactly 1
  std::int64_t edges = 0;  // run edges of all kernels
  FrameFindings findings;
};

// Takes over the whole frame into `state`, without looking at what it held. Fills `max_index` with the
// largest |index| of every tile.
Committed commit_all(const Frame& frame, const CocFunction& coc, const KernelTable& kernels, const Sanitiser& sanitiser,
                     SourceState& state, std::vector<TileWork>& tiles);

// Takes over the pixels of `tiles`.
void commit(const Frame& frame, const Sanitiser& sanitiser, const std::vector<std::int16_t>& pending,
            const std::vector<TileWork>& tiles, SourceState& state);

}  // namespace pullfocus
