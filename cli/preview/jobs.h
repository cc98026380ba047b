// Work that a window must not wait for, one piece after the other on a thread of its own.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace pullfocus::cli::preview {

class Jobs {
 public:
  Jobs() : thread_([this] { work(); }) {}
  ~Jobs();  // does what was added

  void add(std::function<void()> job);  // which must not throw
  int waiting() const;                  // or being done

 private:
  void work();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> jobs_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace pullfocus::cli::preview
