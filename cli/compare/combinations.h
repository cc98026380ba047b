// Which filters `pullfocus compare` runs: every combination of lists of filter options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "filter_options.h"

namespace pullfocus::cli {

// Lists as typed: values with commas between them, or with semicolons if a value holds commas itself
// ("none;layers:-2,2").
struct CombinationLists {
  std::optional<std::string> methods, budgets, orders, visibilities, coc_steps, kernels;
  bool quick = false;  // fewer budgets, unless given
};

// "a,b;c" at the semicolons if there are any, else at the commas. Throws Error(usage) naming the option if nothing is
// left between two of them.
std::vector<std::string> split_list(const std::string& text, const std::string& option);

// One list of filters that share kernel, visibility and CoC step, and so have the same linear filter as reference,
// which comes first, asked for or not.
using Group = std::vector<FilterArguments>;

// Values that are not listed are `base`'s. Each value goes through the option parser of `filter`. Without a budget that
// leaves something over, the order is no dimension: only the first is run. Throws Error(usage): a value that `filter`
// would refuse, or more than 200 filters.
std::vector<Group> combinations(const FilterArguments& base, const CombinationLists& lists);

}  // namespace pullfocus::cli
