#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "bench/table.h"
#include "bench/timing.h"
#include "program.h"

namespace pullfocus::cli::bench {
void PrintTo(const Table& table, std::ostream* out) { *out << table.name; }
}  // namespace pullfocus::cli::bench

namespace pullfocus::test {
namespace {

using cli::bench::Table;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> known_names() {
  std::set<std::string> names;
  for (const Table& table : cli::bench::tables()) names.emplace(table.name);
  return names;
}

// Names after "bench --table".
std::set<std::string> names_in(const std::string& text) {
  static const std::regex pattern("bench --table ([a-z]+)");
  std::set<std::string> names;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) names.insert((*i)[1]);
  return names;
}

class BenchTable : public testing::TestWithParam<Table> {};

TEST_P(BenchTable, QuicklyPrintsHeadingSentenceCommandAndWholeRows) {
  const Table& table = GetParam();
  const std::string options = fmt::format("bench --table {} --quick", table.name);
  const Outcome outcome = run(options);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(
      outcome.out.find(fmt::format("\n## {}\n\n{}\n\n`pullfocus {}`; threads: ", table.title, table.what, options)),
      std::string::npos)
      << outcome.out;
  const std::vector<std::string> lines = lines_of(outcome.out);
  int rows = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!lines[i].starts_with("|") || !lines[i - 1].starts_with("|")) continue;
    EXPECT_EQ(std::ranges::count(lines[i], '|'), std::ranges::count(lines[i - 1], '|')) << lines[i];
    EXPECT_FALSE(std::regex_search(lines[i], std::regex("\\| +\\||nan|inf"))) << lines[i];
    ++rows;
  }
  EXPECT_GT(rows, 1);
}

INSTANTIATE_TEST_SUITE_P(Each, BenchTable, testing::ValuesIn(cli::bench::tables().begin(), cli::bench::tables().end()),
                         [](const auto& table) { return std::string(table.param.name); });

TEST(Bench, TheHelpListsEveryTable) {
  const Outcome outcome = run("bench --help");
  EXPECT_EQ(outcome.code, 0);
  for (const std::string& name : known_names()) EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
}

TEST(Bench, TheDocumentsShowEveryTableAndNoOther) {
  const std::string docs = PULLFOCUS_SOURCE_DIR "/docs/";
  std::set<std::string> shown = names_in(text_of(docs + "benchmarks.md"));
  shown.merge(names_in(text_of(docs + "orders.md")));
  EXPECT_EQ(shown, known_names());
}

TEST(Bench, AnUnknownTableIsOneLineThatListsTheKnownOnes) {
  const Outcome outcome = run("bench --quick --table kernels,fast");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.error_lines(), 1u);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("'fast'"), std::string::npos) << outcome.err;
  for (const std::string& name : known_names()) EXPECT_NE(outcome.err.find(name), std::string::npos) << name;
}

TEST(Bench, WrongOptionsAreNamed) {
  for (const auto& [options, word] :
       std::vector<std::pair<std::string, std::string>>{{"--threads -1", "--threads"},
                                                        {"--threads 9999", "--threads"},
                                                        {"--runs 0", "--runs"},
                                                        {"--table kernels --data x", "orders"}}) {
    const Outcome outcome = run("bench --quick " + options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u);
  }
}

TEST(Bench, SeveralTablesGoToTheFileInTheirOrder) {
  const TempFolder folder;
  const std::string path = folder / "tables.md";
  const Outcome outcome =
      run(fmt::format("bench --quick --runs 2 --threads 2 --table kernels,unchanged -o '{}'", path));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const std::string text = text_of(path);
  EXPECT_TRUE(text.starts_with("# Benchmarks\n")) << text;
  EXPECT_NE(text.find("`pullfocus bench --table kernels,unchanged --quick --threads 2 --runs 2`; threads: 2."),
            std::string::npos)
      << text;
  const auto first = text.find("bench --table unchanged --quick --threads 2 --runs 2`"),
             second = text.find("bench --table kernels --quick --threads 2 --runs 2`");
  EXPECT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
}

TEST(Bench, AFileThatCannotBeWrittenIsNamed) {
  const Outcome outcome = run("bench --quick --table kernels -o /no/such/folder/tables.md");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.error_lines(), 1u);
  EXPECT_NE(outcome.err.find("/no/such/folder/tables.md"), std::string::npos) << outcome.err;
}

TEST(Bench, OrdersWritesABlockAShotForThePlot) {
  const TempFolder folder;
  const std::string path = folder / "orders.data";
  ASSERT_EQ(run(fmt::format("bench --quick --table orders --data '{}'", path)).code, 0);
  std::vector<std::string> shots;
  int rows = 0;
  for (const std::string& line : lines_of(text_of(path))) {
    if (line.starts_with('"')) shots.push_back(line);
    double budget, gain, fearing, random;
    rows += std::istringstream(line) >> budget >> gain >> fearing >> random ? 1 : 0;
  }
  EXPECT_EQ(shots.size(), 5u);
  EXPECT_EQ(rows, 25);
}

TEST(Bench, AnInterruptEndsItAfterTheRowAtHand) {
  const TempFolder folder;
  std::ofstream(folder / "interrupt.sh") << fmt::format(
      "'{0}' bench --quick --runs 20 --table visibility -o '{1}' 2>'{2}' & pid=$!\n"
      "until grep -q '^| 0' '{1}' 2>/dev/null || ! kill -0 $pid; do sleep 0.01; done\n"
      "kill -INT $pid; wait $pid",
      PULLFOCUS_PROGRAM, folder / "tables.md", folder / "error");
  const Outcome outcome = run_program("sh", fmt::format("'{}'", folder / "interrupt.sh"));
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_EQ(lines_of(text_of(folder / "error")).size(), 1u);
  EXPECT_NE(text_of(folder / "error").find("interrupted in the table visibility"), std::string::npos);
  const std::vector<std::string> lines = lines_of(text_of(folder / "tables.md"));
  ASSERT_GE(lines.size(), 2u);
  EXPECT_EQ(lines.back(), "");
  EXPECT_EQ(std::ranges::count(lines[lines.size() - 2], '|'), 10) << lines[lines.size() - 2];
}

TEST(BenchTiming, RatiosAreRoundByRoundAndTheFirstRoundDoesNotCount) {
  int calls = 0;
  const auto times = cli::bench::in_turn(3, {[&] { return 10. * ++calls; }, [&] { return 1. * ++calls; }});
  EXPECT_EQ(times[0], (std::vector<double>{30, 50, 70}));
  EXPECT_EQ(times[1], (std::vector<double>{4, 6, 8}));
  const cli::bench::Spread ratio = cli::bench::ratio(times[0], times[1]);
  EXPECT_DOUBLE_EQ(ratio.least, 7.5);
  EXPECT_DOUBLE_EQ(ratio.median, 50. / 6);
  EXPECT_DOUBLE_EQ(ratio.most, 8.75);
  EXPECT_EQ(cli::bench::text(ratio, 1), "8.3 (7.5-8.8)");
}

TEST(BenchTiming, NumbersHaveThreeSignificantDigits) {
  EXPECT_EQ(cli::bench::text(0.01234), "0.0123");
  EXPECT_EQ(cli::bench::text(1.239), "1.24");
  EXPECT_EQ(cli::bench::text(45.67), "45.7");
  EXPECT_EQ(cli::bench::text(4567.8), "4568");
  EXPECT_EQ(cli::bench::text(0), "0.00");
}

}  // namespace
}  // namespace pullfocus::test
