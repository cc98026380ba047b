// Whether a rebuild is worth keeping the sums of.
#pragma once

#include <algorithm>

namespace pullfocus {

// Writing the sums of every pixel to memory costs a rebuild a tenth to a third more, for nothing if the next frame
// rebuilds again; not having them costs a frame of small changes a whole rebuild. So sums are kept until `patience`
// rebuilds have come in a row; each time they are missed patience doubles, and after every so many rebuilds that were
// right to do without it halves. A function of what the calls counted, never of time, so that runs repeat.
class KeepRule {
 public:
  bool keeps() const noexcept { return in_row_ < patience_; }

  void rebuilt(bool kept) noexcept {
    ++in_row_;
    if (kept || ++saved_ < kWorthOneMiss) return;
    saved_ = 0;
    patience_ = std::max(patience_ / 2, 1);
  }

  // Changes were few enough for an update, which needs sums.
  void updated(bool missed_sums) noexcept {
    in_row_ = saved_ = 0;
    if (missed_sums) patience_ = std::min(2 * patience_, kMostPatience);
  }

 private:
  static constexpr int kWorthOneMiss = 8, kMostPatience = 64;

  int in_row_ = 0;  // rebuilds since the last update
  int saved_ = 0;   // of these, since patience last changed, those that did not keep their sums
  int patience_ = 1;
};

}  // namespace pullfocus
