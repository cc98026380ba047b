#include "preview/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter/core.h"

namespace pullfocus::cli::preview {

void Refinement::begin(Filter& filter, const Frame& frame, const CocFunction& coc, const Budget& budget) {
  filter.set_budget(budget);
  stats_ = filter.filter(frame, coc);
  first_ms_ = total_ms_ = stats_.filter_ms;
  calls_ = 1;
}

void Refinement::go_on(Filter& filter, const Budget& budget, bool hurried, const StopRequest& newer) {
  const double picture_ms = budget.kind == Budget::Kind::time ? budget.amount : kPictureMs;
  const double longest_ms = hurried ? picture_ms : std::max(kFinishMs, picture_ms);
  const double this_ms = std::min(picture_ms * std::exp2(calls_ - 1), longest_ms);
  filter.set_budget({Budget::Kind::time, longest_ms});
  const Stopwatch watch;
  bool asked = false;
  stats_ = filter.refine([&] { return std::exchange(asked, true) && (watch.ms() > this_ms || (newer && newer())); });
  total_ms_ += stats_.filter_ms;
  ++calls_;
}

}  // namespace pullfocus::cli::preview
