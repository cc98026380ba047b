// One call of the incremental filter: when it has to end.
#pragma once

#include "filter/incremental_filter.h"

namespace pullfocus {

class IncrementalFilter::Call {
 public:
  Call(const FilterOptions& options, const StopRequest& stop) : options_(options), stop_(stop), begin_(now()) {}

  bool can_be_stopped() const noexcept { return stop_ || timed(); }
  bool timed() const noexcept { return options_.budget.kind == Budget::Kind::time; }
  bool stopped() const { return stop_ && stop_(); }
  bool has_stop_request() const noexcept { return static_cast<bool>(stop_); }
  double elapsed_ms() const { return now() - begin_; }
  double left_ms() const { return options_.budget.amount - elapsed_ms(); }

 private:
  double now() const { return options_.clock ? options_.clock() : steady_.ms(); }

  const FilterOptions& options_;
  const StopRequest& stop_;
  const Stopwatch steady_;
  const double begin_;
};

}  // namespace pullfocus
