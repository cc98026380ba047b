#include "compare/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "compare/combinations.h"
#include "image/error.h"

namespace pullfocus::cli {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& why) {
  throw Error(ErrorCode::usage, fmt::format("{} '{}' {}", option, text, why));
}

std::string names(bool higher_is_better) {
  std::string text;
  for (const Measure& m : measures()) {
    if (m.higher_is_better == higher_is_better) text += (text.empty() ? "" : ", ") + std::string(m.name);
  }
  return text;
}

Limit parse(const std::string& text, const std::string& option, bool below) {
  Limit limit;
  limit.text = option + " " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    refuse(option, text, "is not METRIC=VALUE, such as " + std::string(below ? "psnr=40" : "rmse=0.001"));
  std::string metric = text.substr(0, equals);
  const std::size_t dot = metric.find('.');
  if (dot != std::string::npos) {
    const std::string against = metric.substr(0, dot);
    metric = metric.substr(dot + 1);
    const auto found = std::ranges::find(kAgainst, against, [](Against a) { return std::string(name(a)); });
    if (found == kAgainst.end() && against != "reference") {
      refuse(option, text, "names an unknown error: use linear, truth, quantisation or reference before the dot");
    }
    if (found != kAgainst.end()) limit.against = *found;
  }
  const auto found = std::ranges::find(measures(), metric, &Measure::name);
  if (found == measures().end()) refuse(option, text, "names no measure: use " + names(below));
  if (found->higher_is_better != below) {
    refuse(option, text,
           fmt::format("is the wrong way round: of {} {} is better: use {}", metric, below ? "less" : "more",
                       below ? "--fail-above" : "--fail-below"));
  }
  limit.measure = &*found;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, limit.value);
  if (error != std::errc{} || stop != end || std::isnan(limit.value)) refuse(option, text, "has no number after the =");
  return limit;
}

}  // namespace

std::vector<Limit> parse_limits(const std::vector<std::string>& texts, bool below) {
  const std::string option = below ? "--fail-below" : "--fail-above";
  std::vector<Limit> limits;
  for (const std::string& text : texts) {
    for (const std::string& part : split_list(text, option)) limits.push_back(parse(part, option, below));
  }
  return limits;
}

void require_measured(const std::vector<Limit>& limits, bool truth, bool quantisation) {
  for (const Limit& limit : limits) {
    if (limit.against == Against::truth && !truth) {
      throw Error(ErrorCode::usage, limit.text + ": there is no truth to compare with: give --truth");
    }
    if (limit.against == Against::quantisation && !quantisation) {
      throw Error(ErrorCode::usage,
                  limit.text + ": quantisation is not measured with --no-quantisation, --quick or --given");
    }
  }
}

std::vector<std::string> violations(const std::vector<Limit>& limits, const std::vector<ShotResult>& shots) {
  std::vector<std::string> lines;
  for (const Limit& limit : limits) {
    const bool below = limit.measure->higher_is_better;
    double worst = 0;
    std::string line;
    for (const ShotResult& shot : shots) {
      for (const Row& row : shot.rows) {
        for (const FrameResult& frame : row.frames) {
          const auto& errors = frame.errors[static_cast<std::size_t>(limit.against)];
          if (!errors) continue;
          const double value = limit.measure->of_frame(*errors, shot.peak);
          if (below ? value >= limit.value : value <= limit.value) continue;
          if (!line.empty() && !(std::isnan(value) || (below ? value < worst : value > worst))) continue;
          worst = value;
          line = fmt::format("{}: {}: {}: frame {}: {} against {} is {}", limit.text, shot.input, row.label,
                             frame.frame, limit.measure->name, shot.given ? "reference" : name(limit.against), value);
        }
      }
    }
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace pullfocus::cli
