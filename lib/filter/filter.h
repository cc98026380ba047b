// The interface of all filters: frames of one shot in, pictures with depth of field out.
#pragma once

#include <functional>
#include <memory>

#include "camera/thin_lens.h"
#include "filter/left_over.h"
#include "filter/options.h"
#include "filter/stats.h"
#include "image/frame.h"

namespace pullfocus {

// Asked at every slice border, from the thread that called filter(); true ends the call early. To stop from another
// thread, let it read a std::stop_token or an atomic flag. A rebuild has no slices: with a stop request it is chosen
// only where there is a time budget too, and it will end within that.
using StopRequest = std::function<bool()>;

// One shot at a time; not to be called from two threads at once. Colour is premultiplied, scene-linear RGBA.
class Filter {
 public:
  virtual ~Filter() = default;

  // Filters one frame. `frame` must have the state window given at construction; its sample type may differ
  // from frame to frame. `coc` holds this frame's lens. Without `stop`, or if it never returns true, the
  // budget is served in full. The references returned by this and by result() hold until the next call.
  // Throws Error(usage) for a frame of another window.
  virtual const Stats& filter(const Frame& frame, const CocFunction& coc, const StopRequest& stop = {}) = 0;

  // Goes on with what the last call left over, without a new frame and whatever the percentage or number of the budget:
  // to the end, or until `stop`, or until a time budget is over. The frame of the last filter() call must still exist,
  // unchanged. With nothing left over it does nothing. What thresholds exempt stays exempt.
  virtual const Stats& refine(const StopRequest& stop = {}) = 0;

  // The picture after the last call, over the state window; its colour is zero outside result_window().
  virtual const ColourImage& result() const noexcept = 0;

  // Where the picture can differ from zero: content grown by its largest kernel, cut to the state window.
  // Depends on the last frame alone if nothing was left over. Never empty: one pixel in the corner if there
  // is no content.
  virtual const Window& result_window() const noexcept = 0;

  // What the last call left over, and how far result() may be from the exact picture. The frame of the last filter()
  // call must still exist. Costs about what reading the frame does.
  virtual LeftOver left_over() = 0;

  // The priority of every pixel left over (see importance/order.h), 0 for all others. The frame as above.
  virtual void left_over_importance(Plane& out) = 0;

  // The budget of the calls that follow. Throws Error(usage) as validate() does.
  virtual void set_budget(const Budget& budget) = 0;

  // Forgets all history: the next frame is a first frame.
  virtual void reset() = 0;
};

// Every frame anew, from nothing.
std::unique_ptr<Filter> make_linear_filter(const Window& state_window, const FilterOptions& options,
                                           std::shared_ptr<const KernelTable> kernels = nullptr);

// Only what changed, with the same result bit for bit when nothing is left over (see incremental_filter.h).
std::unique_ptr<Filter> make_incremental_filter(const Window& state_window, const FilterOptions& options,
                                                std::shared_ptr<const KernelTable> kernels = nullptr);

}  // namespace pullfocus
