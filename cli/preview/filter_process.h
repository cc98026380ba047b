// `pullfocus filter` run from the preview, as a process of its own.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace pullfocus::cli::preview {

class FilterProcess {
 public:
  // Starts this very program with `arguments`, which must ask for statistics on standard output: a line a frame,
  // counted up to `frames`. `on_change` is called from another thread for every frame, and at the end. Throws
  // Error(unwritable) if no process can be started.
  FilterProcess(const std::vector<std::string>& arguments, std::size_t frames, std::function<void()> on_change);
  ~FilterProcess();  // asks it to stop after the frames at hand, and waits for that

  void stop();
  bool is_over() const noexcept { return over_; }
  double share_done() const noexcept;
  int exit_code() const noexcept { return exit_code_; }              // once it is over; negative: ended by a signal
  const std::string& last_error() const noexcept { return error_; }  // once it is over: the last line of its complaints

 private:
  void watch(int output, int complaints);

  const std::size_t frames_;
  const std::function<void()> on_change_;
  pid_t process_ = -1;
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> over_{false};
  std::mutex reaping_;
  bool reaped_ = false;  // the number may belong to another process
  int exit_code_ = 0;
  std::string error_;
  std::thread thread_;
};

}  // namespace pullfocus::cli::preview
