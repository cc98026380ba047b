#include "compare/combinations.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "image/error.h"

namespace pullfocus::cli {

namespace {

constexpr std::size_t kMostFilters = 200;

// `--option=value` of `filter`, on top of `base`.
FilterArguments with(const FilterArguments& base, const std::vector<std::pair<std::string, std::string>>& values) {
  FilterArguments arguments = base;
  CLI::App app;
  add_filter_options(app, arguments);
  std::vector<std::string> words;
  for (const auto& [option, value] : values) words.push_back(fmt::format("{}={}", option, value));
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, error.what());
  }
  check_filter_options(arguments);
  return arguments;
}

bool leaves_over(const std::string& budget) {
  const Budget parsed = Budget::parse(budget);
  return parsed.kind != Budget::Kind::percent || parsed.amount < 100;
}

std::vector<std::string> list(const std::optional<std::string>& text, const std::string& option,
                              const std::string& otherwise) {
  return split_list(text.value_or(otherwise), option);
}

}  // namespace

std::vector<std::string> split_list(const std::string& text, const std::string& option) {
  const char separator = text.find(';') == std::string::npos ? ',' : ';';
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (separator == ';' && parts.back().empty()) parts.pop_back();  // "a,b;" is one value
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) {
      throw Error(ErrorCode::usage, fmt::format("{} '{}' has an empty value: give values with commas between them, or "
                                                "with semicolons if they hold commas",
                                                option, text));
    }
    if (std::find(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), parts[i]) !=
        parts.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw Error(ErrorCode::usage, fmt::format("{} '{}' has {} twice", option, text, parts[i]));
    }
  }
  return parts;
}

std::vector<Group> combinations(const FilterArguments& base, const CombinationLists& lists) {
  const auto methods = list(lists.methods, "--methods", "linear,incremental");
  const auto budgets = list(lists.budgets, "--budgets", lists.quick ? "15%,100%" : "5%,15%,100%");
  const auto orders = list(lists.orders, "--orders", base.order + ";");
  const auto kernels = list(lists.kernels, "--kernels", base.kernel.kernel + ";");
  const auto visibilities = list(lists.visibilities, "--visibilities", base.visibility + ";");
  const auto steps = list(lists.coc_steps, "--coc-steps", fmt::format("{}", base.coc_step));

  std::vector<Group> groups;
  std::size_t count = 0;
  for (const auto& kernel : kernels) {
    for (const auto& visibility : visibilities) {
      for (const auto& step : steps) {
        const FilterArguments shared =
            with(base, {{"--kernel", kernel}, {"--visibility", visibility}, {"--coc-step", step}});
        groups.push_back({with(shared, {{"--method", "linear"}})});
        for (const auto& method : methods) {
          if (parse_method(method) == Method::linear) continue;
          for (const auto& budget : budgets) {
            for (const auto& order : orders) {
              const FilterArguments filter =
                  with(shared, {{"--method", method}, {"--budget", budget}, {"--order", order}});
              if (order == orders.front() || leaves_over(budget)) groups.back().push_back(filter);
            }
          }
        }
        count += groups.back().size();
      }
    }
  }
  if (count > kMostFilters) {
    throw Error(ErrorCode::usage,
                fmt::format("the lists make {} filters, more than {}: shorten them", count, kMostFilters));
  }
  return groups;
}

}  // namespace pullfocus::cli
