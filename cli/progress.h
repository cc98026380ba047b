// The progress line of a batch run.
#pragma once

#include <chrono>
#include <cstddef>

namespace pullfocus::cli {

// Writes "frame 12   3/100   14.2 fps   0:07 left" to stderr, over itself, if stderr is a terminal; else
// nothing.
class Progress {
 public:
  explicit Progress(std::size_t frames);
  ~Progress();  // leaves the cursor on an empty line
  void done(int frame);

 private:
  const std::size_t frames_;
  const bool terminal_;
  std::size_t finished_ = 0;
  const std::chrono::steady_clock::time_point start_;
};

}  // namespace pullfocus::cli
