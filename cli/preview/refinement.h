// How the preview spends time: a first picture soon, better ones after it, and the exact one before long.
#pragma once

#include <functional>

#include "filter/filter.h"

namespace pullfocus::cli::preview {

class Refinement {
 public:
  static constexpr double kPictureMs = 16;  // one picture of a 60 Hz screen
  static constexpr double kFinishMs = 200;  // a rebuild may take so long where nobody waits for another picture

  // The first picture of a frame and a lens, within `budget`. The frame must outlive the refinement of it.
  void begin(Filter& filter, const Frame& frame, const CocFunction& coc, const Budget& budget);

  // A better one, unless it is exact. In a hurry, which is while more wishes are coming, it takes no longer than the
  // budget's time (kPictureMs where that is no time). Else each one may take twice as long as the one before, up to
  // kFinishMs, since what a call begins with takes its time too, and a rebuild is made if it takes no longer. Ends
  // early, but not without progress, when `newer` is true.
  void go_on(Filter& filter, const Budget& budget, bool hurried, const StopRequest& newer);

  bool is_exact() const noexcept { return stats_.left_over == 0; }
  const Stats& stats() const noexcept { return stats_; }  // of the last call
  int calls() const noexcept { return calls_; }           // of the filter, since and with begin()
  double first_ms() const noexcept { return first_ms_; }  // filter time of begin()
  double total_ms() const noexcept { return total_ms_; }  // and of all calls

 private:
  Stats stats_;
  int calls_ = 0;
  double first_ms_ = 0, total_ms_ = 0;
};

}  // namespace pullfocus::cli::preview
