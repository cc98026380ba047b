#include "bench/table.h"

namespace pullfocus::cli::bench {

std::span<const Table> tables() {
  static const Table all[] = {kNaiveTable,   kChangeTable,     kUnchangedTable, kThreadsTable, kSizesTable,
                              kKernelsTable, kVisibilityTable, kStarTable,      kPaperTable,   kStepsTable,
                              kOrdersTable,  kBatchTable,      kPreviewTable};
  return all;
}

}  // namespace pullfocus::cli::bench
