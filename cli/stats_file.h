// --stats FILE: one JSON object a line, one line a frame.
#pragma once

#include <memory>
#include <string>

#include "filter/stats.h"
#include "image/window.h"

namespace pullfocus::cli {

struct FrameRecord {
  int frame = 0;
  Window window;  // state window
  Stats stats;
  std::size_t outside = 0;  // pixels of the file outside the state window
  std::int64_t mixed = 0;   // depths that --repair-depth replaced
  double read_ms = 0, write_ms = 0;
};

class StatsFile {
 public:
  // Empty: none; "-": standard output. Throws Error(unwritable) naming --stats.
  explicit StatsFile(const std::string& path);
  ~StatsFile();
  void write(const FrameRecord& record);  // flushed, so that a run can be watched; throws Error(unwritable)

 private:
  struct Output;
  std::unique_ptr<Output> output_;
};

}  // namespace pullfocus::cli
