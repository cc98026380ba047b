// --fail-above and --fail-below: the comparison as a judge.
#pragma once

#include <string>
#include <vector>

#include "compare/results.h"

namespace pullfocus::cli {

struct Limit {
  std::string text;  // as typed
  Against against = Against::linear;
  const Measure* measure = nullptr;
  double value = 0;
};

// "[AGAINST.]METRIC=VALUE,...", AGAINST linear (default), truth, quantisation, or reference, which means the same as
// linear. --fail-above takes measures of which less is better, --fail-below (`below`) the others. Throws Error(usage).
std::vector<Limit> parse_limits(const std::vector<std::string>& texts, bool below);

// Throws Error(usage) if a limit is about an error that is not going to be measured.
void require_measured(const std::vector<Limit>& limits, bool truth, bool quantisation);

// One line a limit that does not hold: the shot, filter and frame that miss it most, and the value. NaN never holds.
std::vector<std::string> violations(const std::vector<Limit>& limits, const std::vector<ShotResult>& shots);

}  // namespace pullfocus::cli
