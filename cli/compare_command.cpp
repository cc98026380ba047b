#include <fmt/format.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "command.h"
#include "compare/limits.h"
#include "compare/report.h"
#include "compare/run.h"
#include "image/error.h"

namespace pullfocus::cli {

namespace {

struct Arguments {
  InputArguments input;
  CameraArguments camera;
  FilterArguments filter;
  CompareArguments compare;
};

void add_list_options(CLI::App& app, CombinationLists& lists) {
  const char* group = "Combinations";
  const auto add = [&](const char* option, std::optional<std::string>& list, const char* what) {
    app.add_option(option, list, what)->type_name("A,B,...")->group(group);
  };
  add("--methods", lists.methods, "as filter --method; linear is always run (default: linear,incremental)");
  add("--budgets", lists.budgets, "as filter --budget (default: 5%,15%,100%)");
  add("--orders", lists.orders, "as filter --order (default: that option's value, as for all that follow)");
  add("--visibilities", lists.visibilities, "as filter --visibility; with ; between values that hold commas");
  add("--coc-steps", lists.coc_steps, "as filter --coc-step");
  add("--kernels", lists.kernels, "as filter --kernel");
  app.add_flag("--quick", lists.quick, "the first 6 frames, budgets 15% and 100%, no quantisation")->group(group);
}

void add_compare_options(CLI::App& app, CompareArguments& a) {
  const auto take_all = CLI::MultiOptionPolicy::TakeAll;
  const char* group = "Comparison";
  app.add_option("--truth", a.truths, "EXR sequence of the truth; for several inputs one each, in their order")
      ->type_name("PATTERN")
      ->group(group)
      ->multi_option_policy(take_all)
      ->allow_extra_args(false);
  app.add_flag("--given", a.given, "filter nothing: compare the input itself with --reference")->group(group);
  app.add_option("--reference", a.references, "EXR sequence that --given inputs should equal; one an input")
      ->type_name("PATTERN")
      ->group(group)
      ->multi_option_policy(take_all)
      ->allow_extra_args(false);
  app.add_option("--peak", a.peak, "largest value that PSNR knows, scene-linear")->group(group)->capture_default_str();
  app.add_flag("--no-quantisation", a.no_quantisation, "leave the error of the CoC steps out")->group(group);
  app.add_option("--fail-above", a.fail_above,
                 "METRIC=VALUE: exit with 1 if a frame's rmse, relmse, largest or flip is above")
      ->type_name("METRIC=VALUE")
      ->group(group)
      ->multi_option_policy(take_all)
      ->allow_extra_args(false);
  app.add_option("--fail-below", a.fail_below, "METRIC=VALUE: exit with 1 if a frame's psnr or ssim is below")
      ->type_name("METRIC=VALUE")
      ->group(group)
      ->multi_option_policy(take_all)
      ->allow_extra_args(false);
  app.add_option("--measure-every", a.measure_every, "measure errors on every K-th frame only, from the first")
      ->type_name("K")
      ->group(group)
      ->capture_default_str();
  app.add_option("--json", a.json, "write everything measured, frame by frame")->type_name("FILE")->group(group);
  app.add_option("--csv", a.csv, "write the table")->type_name("FILE")->group(group);
  app.add_option("--markdown", a.markdown, "write the table as part of a Markdown document")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--html", a.html, "write one page with table, plots and pictures")->type_name("FILE")->group(group);
}

void check_counts(const CompareArguments& a) {
  const auto check = [&](const std::vector<std::string>& patterns, const char* option) {
    if (patterns.empty() || patterns.size() == a.inputs.size()) return;
    throw Error(ErrorCode::usage, fmt::format("{} is given {} times for {} inputs: give one for each, in their order",
                                              option, patterns.size(), a.inputs.size()));
  };
  check(a.truths, "--truth");
  check(a.references, "--reference");
  if (a.given && a.references.empty()) throw Error(ErrorCode::usage, "--given needs --reference: what to compare with");
  if (!a.given && !a.references.empty()) {
    throw Error(ErrorCode::usage, "--reference needs --given: to compare filtered pictures, give --truth");
  }
  if (a.given && !a.truths.empty()) throw Error(ErrorCode::usage, "--truth does not go with --given: use --reference");
  if (a.measure_every < 1) throw Error(ErrorCode::usage, "--measure-every must be at least 1: give a number of frames");
  if (a.given && a.measure_every > 1) {
    throw Error(ErrorCode::usage, "--measure-every does not go with --given: choose frames with --frames");
  }
  if (!(a.peak > 0) || !std::isfinite(a.peak)) throw Error(ErrorCode::usage, "--peak must be greater than 0");
}

std::string truth_of(const CompareArguments& a, std::size_t i) { return a.truths.empty() ? "" : a.truths[i]; }

ShotResult compare_one(const Arguments& a, const std::vector<Group>& groups, std::size_t i) {
  InputArguments input = a.input;
  input.input = a.compare.inputs[i];
  if (a.compare.given) return compare_given(input, a.compare.references[i], a.compare);
  return FilterComparison(input, a.camera, groups, a.compare, truth_of(a.compare, i)).run();
}

int compare(const Arguments& a) {
  const CompareArguments& c = a.compare;
  check_counts(c);
  std::vector<Limit> limits = parse_limits(c.fail_above, false);
  for (const Limit& limit : parse_limits(c.fail_below, true)) limits.push_back(limit);
  require_measured(limits, !c.truths.empty(), !c.given && !c.no_quantisation && !c.lists.quick);
  const std::vector<Group> groups = combinations(a.filter, c.lists);
  check_report_path("--json", c.json);
  check_report_path("--csv", c.csv);
  check_report_path("--html", c.html);
  check_report_path("--markdown", c.markdown);
  use_threads(a.filter.threads);

  std::vector<ShotResult> shots;
  for (std::size_t i = 0; i < c.inputs.size(); ++i) {
    shots.push_back(compare_one(a, groups, i));
    shots.back().threads = a.filter.threads > 0 ? a.filter.threads : tbb::info::default_concurrency();
    fmt::print("{}{}", i > 0 ? "\n" : "", table(shots.back()));
    std::fflush(stdout);
  }
  if (!c.json.empty()) write_report("--json", c.json, json_report(shots));
  if (!c.csv.empty()) write_report("--csv", c.csv, csv_report(shots));
  if (!c.html.empty()) write_report("--html", c.html, html_report(shots));
  if (!c.markdown.empty()) write_report("--markdown", c.markdown, markdown_report(shots));

  const std::vector<std::string> broken = violations(limits, shots);
  for (const std::string& line : broken) std::fprintf(stderr, "pullfocus: %s\n", line.c_str());
  return broken.empty() ? kDone : kFrameFailed;
}

}  // namespace

Run add_compare_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  add_input_options(app, a->input);
  app.remove_option(app.get_option("input"));
  app.add_option("input", a->compare.inputs,
                 "sequences: shot.####.exr, shot.%04d.exr, shot.1-100#.exr, or single files")
      ->required()
      ->type_name("IN...")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_camera_options(app, a->camera);
  add_filter_options(app, a->filter);
  for (const char* one : {"--method", "--budget"}) app.remove_option(app.get_option(one));  // they are lists here
  add_list_options(app, a->compare.lists);
  add_compare_options(app, a->compare);
  return [a] { return compare(*a); };
}

}  // namespace pullfocus::cli
