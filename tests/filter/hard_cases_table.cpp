// The tables of docs/hard-cases.md. All numbers are repeatable: there are no times among them.
//
//   hard_cases_table --markdown     prints them
//   hard_cases_table --check FILE   compares the lines of tables in FILE with them; exit 1 if any differs
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "hard_measures.h"
#include "hard_shots.h"

namespace {

using namespace pullfocus;

std::string cells(const test::Outcome& outcome) {
  return fmt::format("{:.0e} | {} | {}", outcome.error, outcome.not_finite, outcome.same_bits ? "yes" : "no");
}

void shots(std::vector<std::string>& lines) {
  lines.push_back(
      "| shot | size | frames | float32: error | not finite | same bits again | filter: error | not finite | "
      "same bits again |");
  lines.push_back("|---|---|---|---|---|---|---|---|---|");
  for (const test::HardShot& shot : test::hard_shots()) {
    const test::Comparison is = test::compare(shot, 1);
    lines.push_back(fmt::format("| {} | {}x{} | {} | {} | {} |", shot.name, shot.window.width(), shot.window.height(),
                                shot.frames, cells(is.float32), cells(is.filter)));
  }
}

void steps(std::vector<std::string>& lines) {
  lines.push_back("| CoC, px | largest change at an edge | of a point |");
  lines.push_back("|---|---|---|");
  const auto all = test::table_steps(64);
  test::TableStep rest;
  constexpr double shown_to = 6;
  for (const test::TableStep& step : all) {
    if (step.to_px <= shown_to) {
      lines.push_back(
          fmt::format("| {:g} to {:g} | {:.3f} | {:.3f} |", step.from_px, step.to_px, step.edge, step.point));
      continue;
    }
    rest.edge = std::max(rest.edge, step.edge);
    rest.point = std::max(rest.point, step.point);
  }
  lines.push_back(fmt::format("| any step from {:g} to {:g} | {:.3f} | {:.3f} |", shown_to, all.back().to_px, rest.edge,
                              rest.point));
}

void terraces(std::vector<std::string>& lines) {
  const test::Terraces is = test::half_terraces();
  lines.push_back("| pixels with another index | by at most | largest change of the picture |");
  lines.push_back("|---|---|---|");
  lines.push_back(fmt::format("| {:.1f} % | {} | {:.4f} |", 100 * is.share, is.largest_index, is.picture));
}

void sums(std::vector<std::string>& lines) {
  lines.push_back("| kernels up to, px | B | radiance | largest sum / 2^63 | as in 128 bits |");
  lines.push_back("|---|---|---|---|---|");
  for (const double max_coc : {30., 400.}) {
    for (const float radiance : {65504.f, 0.f}) {
      const test::LargestSum sum = test::largest_sum(max_coc, radiance);
      const bool exact = sum.positive == sum.expected && sum.negative == -sum.expected;
      lines.push_back(fmt::format("| {:g} | {:.3f} | {:.1f} | {:.6f} | {} |", max_coc, sum.overlap, sum.radiance,
                                  sum.share(), exact ? "yes" : "no"));
    }
  }
}

void budgets(std::vector<std::string>& lines) {
  lines.push_back("| budget | longest wait, frames | promised | updates in a block of 16x16: mean | fewest | most |");
  lines.push_back("|---|---|---|---|---|---|");
  for (const char* text : {"5%", "10%", "50%", "400"}) {
    const Budget budget = Budget::parse(text);
    const test::OneBucket is = test::one_bucket(budget, 60);
    const int promised = budget.longest_wait();
    lines.push_back(fmt::format("| {} | {} | {} | {:.1f} | {} | {} |", text, is.longest_wait,
                                promised > 0 ? std::to_string(promised) : "none", is.per_block, is.fewest, is.most));
  }
}

constexpr void (*kParts[])(std::vector<std::string>&) = {shots, steps, terraces, sums, budgets};

std::vector<std::string> tables_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('|')) lines.push_back(line);
  }
  return lines;
}

int check(const std::string& path) {
  std::vector<std::string> expected;
  for (const auto part : kParts) part(expected);
  const std::vector<std::string> is = tables_of(path);
  int differences = 0;
  for (std::size_t i = 0; i < std::max(is.size(), expected.size()); ++i) {
    const std::string in_file = i < is.size() ? is[i] : "", measured = i < expected.size() ? expected[i] : "";
    if (in_file == measured) continue;
    fmt::print("{} says\n  {}\nmeasured\n  {}\n", path, in_file, measured);
    ++differences;
  }
  return differences == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--check") == 0) return check(argv[2]);
  if (argc != 2 || std::strcmp(argv[1], "--markdown") != 0) {
    fmt::print(stderr, "hard_cases_table --markdown | --check FILE\n");
    return 2;
  }
  for (const auto part : kParts) {
    std::vector<std::string> lines;
    part(lines);
    for (const std::string& line : lines) fmt::print("{}\n", line);
    fmt::print("\n");
  }
  return 0;
}
