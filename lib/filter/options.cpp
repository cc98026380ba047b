#include "filter/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "filter/stats.h"
#include "image/error.h"

namespace pullfocus {

const char* name(ScatterMode mode) noexcept {
  switch (mode) {
    case ScatterMode::unchanged:
      return "unchanged";
    case ScatterMode::incremental:
      return "incremental";
    case ScatterMode::rebuild:
      return "rebuild";
  }
  return "";
}

std::int64_t Budget::pixels(std::int64_t changed) const noexcept {
  switch (kind) {
    case Kind::percent:
      return amount >= 100 ? changed
                           : static_cast<std::int64_t>(std::ceil(static_cast<double>(changed) * amount / 100));
    case Kind::count:
      return amount < static_cast<double>(changed) ? static_cast<std::int64_t>(amount) : changed;
    case Kind::time:
      return changed;
  }
  return changed;
}

int Budget::longest_wait() const noexcept {
  return kind == Kind::percent ? static_cast<int>(std::min(std::ceil(200 / amount), 60000.)) : 0;
}

namespace {

bool in_range(const Budget& budget) noexcept {
  switch (budget.kind) {
    case Budget::Kind::percent:
      return budget.amount > 0 && budget.amount <= 100;
    case Budget::Kind::count:
      return budget.amount >= 0 && budget.amount < 1e15 && budget.amount == std::floor(budget.amount);
    case Budget::Kind::time:
      return budget.amount > 0 && budget.amount < 1e9;
  }
  return false;
}

}  // namespace

Budget Budget::parse(std::string_view text) {
  Budget budget;
  std::string_view digits = text;
  const auto take_unit = [&](std::string_view unit) {
    if (!digits.ends_with(unit)) return false;
    digits.remove_suffix(unit.size());
    return true;
  };
  budget.kind = take_unit("%") ? Kind::percent : take_unit("ms") ? Kind::time : Kind::count;
  const char* end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, budget.amount);
  if (parsed.ec != std::errc{} || parsed.ptr != end || !in_range(budget)) {
    throw Error(ErrorCode::usage, fmt::format("--budget '{}' is neither a percentage above 0 and up to 100, such as "
                                              "15%, nor a number of pixels, such as 200000, nor a time, such as 40ms",
                                              text));
  }
  return budget;
}

void validate(const FilterOptions& options) {
  validate(options.visibility);
  validate(options.importance);
  validate(options.thresholds);
  validate(ChangeThresholds{0, 0, options.error_bound});
  if (options.threads < 0 || options.threads > 1024) {
    throw Error(ErrorCode::usage, "--threads must lie between 1 and 1024, or be 0 for all processors");
  }
  if (!in_range(options.budget)) {
    throw Error(ErrorCode::usage,
                "--budget must be a percentage above 0 and up to 100, a number of pixels, or a time above 0");
  }
  const bool full = options.budget.kind == Budget::Kind::percent && options.budget.amount == 100;
  if (options.error_bound > 0 && (!full || options.thresholds.any())) {
    throw Error(ErrorCode::usage,
                "--error-bound holds only with --budget 100% and without --coc-threshold and "
                "--rgb-threshold: leave those out");
  }
  if (options.slice_edges < 1) throw Error(ErrorCode::usage, "slice_edges must be at least 1");
}

}  // namespace pullfocus
