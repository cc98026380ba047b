#include <fmt/format.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "bench/machine.h"
#include "bench/table.h"
#include "command.h"
#include "image/error.h"

namespace pullfocus::cli {

namespace {

struct Arguments {
  std::vector<std::string> tables;
  std::optional<int> threads, runs;
  std::string output, data;
  bool quick = false;
};

std::string known_names() {
  std::vector<std::string_view> names;
  for (const bench::Table& table : bench::tables()) names.push_back(table.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// In the order of the list of all.
std::vector<const bench::Table*> chosen(const Arguments& a) {
  for (const std::string& name : a.tables) {
    if (std::ranges::none_of(bench::tables(), [&](const bench::Table& table) { return table.name == name; }))
      throw Error(ErrorCode::usage, fmt::format("--table '{}' is not known: use {}", name, known_names()));
  }
  std::vector<const bench::Table*> tables;
  for (const bench::Table& table : bench::tables()) {
    if (a.tables.empty() || std::ranges::find(a.tables, table.name) != a.tables.end()) tables.push_back(&table);
  }
  return tables;
}

bench::Settings settings_of(const Arguments& a, const std::vector<const bench::Table*>& tables) {
  if (a.threads && (*a.threads < 0 || *a.threads > 1024))
    throw Error(ErrorCode::usage, "--threads must lie between 1 and 1024, or be 0 for all processors");
  if (a.runs && (*a.runs < 1 || *a.runs > 100000))
    throw Error(ErrorCode::usage, "--runs must lie between 1 and 100000: give a number of runs");
  if (!a.data.empty() &&
      std::ranges::none_of(tables, [](const auto* table) { return table->name == bench::kOrdersTable.name; }))
    throw Error(ErrorCode::usage, "--data is written by the table orders: add it to --table");
  bench::Settings settings;
  settings.quick = a.quick;
  settings.processors = tbb::info::default_concurrency();
  settings.threads = a.threads;
  if (settings.threads == 0) settings.threads = settings.processors;
  settings.runs = a.runs;
  settings.data = a.data;
  return settings;
}

// What gives the same table again.
std::string command(const Arguments& a, const std::string& tables) {
  std::string text = "pullfocus bench";
  if (!tables.empty()) text += " --table " + tables;
  if (a.quick) text += " --quick";
  if (a.threads) text += fmt::format(" --threads {}", *a.threads);
  if (a.runs) text += fmt::format(" --runs {}", *a.runs);
  return text;
}

std::string threads_in_words(const bench::Settings& settings, std::string_view own) {
  return settings.threads ? fmt::format("{}", *settings.threads) : std::string(own);
}

// Closes what it opened; the standard output stays open.
class Output {
 public:
  explicit Output(const std::string& path) : path_(path) {
    if (path.empty()) return;
    file_ = std::fopen(path.c_str(), "w");
    if (file_ == nullptr) fail();
  }
  ~Output() {
    if (file_ != stdout) std::fclose(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  std::FILE* file() const noexcept { return file_; }
  void check() const {
    if (std::fflush(file_) != 0 || std::ferror(file_) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ErrorCode::unwritable, fmt::format("{}: cannot be written: {}",
                                                   path_.empty() ? "standard output" : path_, std::strerror(errno)));
  }
  std::string path_;
  std::FILE* file_ = stdout;
};

void print(const bench::Table& table, const Arguments& a, const bench::Settings& settings, bench::Report& report) {
  report.paragraph(fmt::format("## {}", table.title));
  report.paragraph(std::string(table.what));
  std::string line =
      fmt::format("`{}`; threads: {}", command(a, std::string(table.name)),
                  table.threads_are_fixed ? std::string(table.threads) : threads_in_words(settings, table.threads));
  if (a.quick) line += "; small and once, to see that it runs: sizes and threads above do not hold";
  report.paragraph(line + ".");
  use_threads(std::max(settings.processors, settings.threads_or(1)));
  table.print(settings, report);
}

int bench_tables(const Arguments& a) {
  const std::vector<const bench::Table*> tables = chosen(a);
  const bench::Settings settings = settings_of(a, tables);
  const Output output(a.output);
  bench::Report report(output.file());
  report.paragraph("# Benchmarks");
  report.paragraph(fmt::format("{}. `{}`; threads: {}.", bench::machine_and_compiler(),
                               command(a, fmt::format("{}", fmt::join(a.tables, ","))),
                               threads_in_words(settings, "as each table says")));
  for (const bench::Table* table : tables) {
    try {
      print(*table, a, settings, report);
    } catch (const bench::Interrupted&) {
      report.end();
      output.check();
      throw Error(ErrorCode::content,
                  fmt::format("interrupted in the table {}: rows so far were written", table->name));
    }
    output.check();
  }
  return kDone;
}

}  // namespace

Run add_bench_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  app.add_option("--table", a->tables, fmt::format("which tables: {}; default: all", known_names()))
      ->type_name("NAME,...")
      ->delimiter(',');
  app.add_flag("--quick", a->quick, "small pictures, few frames, one run: to see that it runs");
  app.add_option(
      "--threads", a->threads,
      "number of threads, the largest one in tables that have several; 0: one a processor; default: what each "
      "table says");
  app.add_option("--runs", a->runs, "runs in turn that medians are taken of; default: each table's own");
  app.add_option("-o,--out", a->output, "file for the tables; default: the standard output")->type_name("FILE");
  app.add_option("--data", a->data, "orders: also write what docs/orders.gp plots")->type_name("FILE");
  return [a] { return bench_tables(*a); };
}

}  // namespace pullfocus::cli
