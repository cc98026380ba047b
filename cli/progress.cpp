#include "progress.h"

#include <unistd.h>

#include <cstdio>

namespace pullfocus::cli {

Progress::Progress(std::size_t frames)
    : frames_(frames), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (terminal_ && finished_ > 0) std::fprintf(stderr, "\r\033[K");
}

void Progress::done(int frame) {
  ++finished_;
  if (!terminal_) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double fps = static_cast<double>(finished_) / seconds;
  const auto left = static_cast<int>(static_cast<double>(frames_ - finished_) / fps + 0.5);
  std::fprintf(stderr, "\r\033[Kframe %d   %zu/%zu   %.1f fps   %d:%02d left", frame, finished_, frames_, fps,
               left / 60, left % 60);
}

}  // namespace pullfocus::cli
