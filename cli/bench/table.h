// The tables that `pullfocus bench` prints, one file each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/report.h"

namespace pullfocus::cli::bench {

struct Settings {
  bool quick = false;          // small and few: to see that it runs
  std::optional<int> threads;  // >= 1; unset: the table's own
  std::optional<int> runs;     // >= 1; unset: the table's own
  std::string data;            // file for the plot of [orders]; empty: none
  int processors = 1;          // of the machine

  int threads_or(int own) const noexcept { return threads.value_or(own); }
  int runs_or(int own) const noexcept { return runs.value_or(quick ? 1 : own); }
};

struct Table {
  std::string_view name;     // as --table spells it
  std::string_view title;    // of its section
  std::string_view what;     // is measured: one sentence
  std::string_view threads;  // that it runs on, in words, if --threads does not say otherwise
  void (*print)(const Settings& settings, Report& report);  // throws Error, Interrupted
  bool threads_are_fixed = false;                           // whatever --threads says
};

// In the order in which they are printed.
std::span<const Table> tables();

extern const Table kNaiveTable, kChangeTable, kUnchangedTable, kKernelsTable, kVisibilityTable, kThreadsTable,
    kSizesTable, kStarTable, kPaperTable, kStepsTable, kOrdersTable, kBatchTable, kPreviewTable;

}  // namespace pullfocus::cli::bench
