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
  if (kind == Kind::count) return amount < static_cast<double>(changed) ? static_cast<std::int64_t>(amount) : changed;
  return amount >= 100 ? changed : static_cast<std::int64_t>(std::ceil(static_cast<double>(changed) * amount / 100));
}

int Budget::longest_wait() const noexcept {
  return kind == Kind::percent ? static_cast<int>(std::min(std::ceil(200 / amount), 60000.)) : 0;
}

Budget Budget::parse(std::string_view text) {
  Budget budget;
  const bool percent = text.ends_with('%');
  budget.kind = percent ? Kind::percent : Kind::count;
  const std::string_view digits = percent ? text.substr(0, text.size() - 1) : text;
  const char* end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, budget.amount);
  const bool whole = percent || budget.amount == std::floor(budget.amount);
  const bool in_range =
      percent ? budget.amount > 0 && budget.amount <= 100 : budget.amount >= 0 && budget.amount < 1e15;
  if (parsed.ec != std::errc{} || parsed.ptr != end || !whole || !in_range) {
    throw Error(ErrorCode::usage, fmt::format("--budget '{}' is neither a percentage above 0 and up to 100, such as "
                                              "15%, nor a number of pixels, such as 200000",
                                              text));
  }
  return budget;
}

void validate(const FilterOptions& options) {
  validate(options.importance);
  validate(options.thresholds);
  if (options.threads < 0 || options.threads > 1024) {
    throw Error(ErrorCode::usage, "--threads must lie between 1 and 1024, or be 0 for all processors");
  }
  const Budget& budget = options.budget;
  const bool percent = budget.kind == Budget::Kind::percent;
  if (!(percent ? budget.amount > 0 && budget.amount <= 100 : budget.amount >= 0)) {
    throw Error(ErrorCode::usage, "--budget must be a percentage above 0 and up to 100, or a number of pixels");
  }
  if (options.slice_edges < 1) throw Error(ErrorCode::usage, "slice_edges must be at least 1");
}

}  // namespace pullfocus
