// The incremental filter (Fearing 1996): remembers what every pixel contributed and recomputes what changed.
//
// Stage          reads                          writes
// find_changes   frame, committed state         masks of changed pixels, their new indices, depths that stay
// select         masks, importance              the set the budget affords, in slices if the call can be stopped
// scatter        committed state, frame         destination bands: old contributions out, new ones in
// integrate      bands                          accumulators, dirty spans
// commit         frame                          committed state
// resolve        accumulators, dirty spans      result, and what is seen behind foregrounds
// fill           what is seen there             result, in holes
//
// Where frames change throughout, every one is rebuilt: detection then commits on the way, and sums are resolved and
// forgotten, as in the linear filter, until a call needs them (see keep_rule.h). They are then made from the committed
// state before anything is added to them.
//
// With bitmaps, scatter puts back what the old state hid, and pixels that begin or cease to hide others are corrected
// before the commit; what the new state hides is taken out after it.
//
// The invariant, at every slice border: the accumulators, if kept, equal what scattering the committed state from
// nothing would give, bit for bit. So with nothing left over the result is the linear filter's, whatever the
// history.
#pragma once

#include <optional>
#include <span>

#include "filter/core.h"
#include "filter/keep_rule.h"
#include "filter/pace.h"
#include "importance/select.h"
#include "importance/slices.h"
#include "resolve/layer_sums.h"
#include "resolve/spans.h"

namespace pullfocus {

class IncrementalFilter final : public Filter {
 public:
  IncrementalFilter(const Window& state_window, const FilterOptions& options,
                    std::shared_ptr<const KernelTable> kernels = nullptr);

  const Stats& filter(const Frame& frame, const CocFunction& coc, const StopRequest& stop = {}) override;
  const Stats& refine(const StopRequest& stop = {}) override;
  const ColourImage& result() const noexcept override { return result_; }
  const Window& result_window() const noexcept override { return result_window_; }
  LeftOver left_over() override;
  void left_over_importance(Plane& out) override;
  void set_budget(const Budget& budget) override { core_.set_budget(budget); }
  void reset() override;

  // For tests and tools: the committed state, and its sums by layer, lanes() values a pixel, row by row; where they
  // were not kept they are made for the answer.
  const SourceState& committed() const noexcept { return state_; }
  std::vector<Accumulator> accumulators(int layer = 0) const;
  bool keeps_sums() const noexcept { return sums_kept_; }  // after the last call
  const Layers& layers() const noexcept { return core_.layers; }
  int lanes() const noexcept { return sums_.lanes(); }
  std::size_t sum_bytes() const noexcept { return sums_.bytes(); }        // of memory
  const Occlusion* occlusion() const noexcept { return core_.hidden(); }  // null without bitmaps

 private:
  class Call;

  const Frame& in_state_type(const Frame& frame);
  void prepare_result(SampleType type);
  Pending pending() const;
  ChangeThresholds thresholds() const noexcept;
  bool takes_all_at_once(const Call& call) const noexcept;
  Changes detect(const CocFunction& coc, bool and_commit);
  std::vector<TileWork> select(const Changes& changes) const;
  // `committed`: detection has taken over all of `selected` already, with so many edges; null: it has not.
  void finish(Call& call, std::vector<TileWork> changed, const std::vector<TileWork>& selected,
              const EdgeCount* committed);
  // Scatters and commits the selection, in slices if the call can be stopped; returns what was committed.
  std::vector<TileWork> take_over(Call& call, const std::vector<TileWork>& selected);
  std::vector<TileWork> take_over_in_slices(Call& call, const std::vector<TileWork>& selected, const EdgeCount& edges);
  bool rebuild_is_cheaper(const EdgeCount& edges, const std::vector<TileWork>& selected) const noexcept;
  // `resolve`: what it reaches at once, while the sums are in the caches; before the changes are committed.
  void add(const std::vector<LayerWork>& work, const Sources& sources, bool resolve);
  // `is_last`: no other one follows in the same call.
  void update(const std::vector<TileWork>& selected, const EdgeCount& edges, bool is_last);
  void take_committed(const Call& call, const std::vector<TileWork>& selected, const EdgeCount& edges);
  // Of the state with `selected` committed; `is_cheaper`: than an update, were the sums at hand.
  void rebuild(const std::vector<TileWork>& selected, bool is_cheaper, const Call& call);
  void scatter_state(bool keep, bool resolve);
  void mark_held_out(const std::vector<TileWork>& tiles);
  void make_room(const LayerWork& work);
  void resolve_dirty();
  void resolve_rows_of_sums();
  // Returns how many pixels were resolved. Before the changes are committed, pixels without weight stay dirty: they
  // show committed colours.
  std::int64_t resolve_dirty_row(int y, bool is_committed);
  void no_longer_uncommitted(const std::vector<TileWork>& tiles);
  void show_uncommitted();

  FilterCore core_;
  SourceState state_;
  std::vector<std::int16_t> pending_;
  RememberedDepths remembered_;
  LayerSums sums_;
  bool sums_kept_ = true;  // false: what they hold means nothing
  KeepRule keep_rule_;
  WaitingTimes waiting_;
  Pace pace_;
  std::uint32_t round_ = 0;                   // number of calls
  const Frame* frame_ = nullptr;              // of the last call, in the state's type
  DepthKind depth_kind_ = DepthKind::planar;  // of that frame
  Window reached_;                            // by that frame
  std::vector<TileWork> left_;                // what it left over
  std::optional<SliceQueue> queue_;           // that holds exactly that, if it was cut into slices
  std::int64_t uncommitted_ = 0;              // pixels never committed
  std::int64_t edges_ = 0;                    // of the committed state
  DirtySpans dirty_;
  Frame widened_;
  ColourImage result_;
  Window result_window_;
  Stats stats_;
};

}  // namespace pullfocus
