#include "preview/filter_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <system_error>

#include "image/error.h"

namespace pullfocus::cli::preview {

namespace {

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(ErrorCode::unwritable, "no process can be started: no pipe is left");
    read = ends[0];
    write = ends[1];
  }
};

}  // namespace

FilterProcess::FilterProcess(const std::vector<std::string>& arguments, std::size_t frames,
                             std::function<void()> on_change)
    : frames_(std::max<std::size_t>(frames, 1)), on_change_(std::move(on_change)) {
  const Pipe output, complaints;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, complaints.write, STDERR_FILENO);
  std::vector<std::string> words{"pullfocus"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int failure = posix_spawn(&process_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(output.write);
  close(complaints.write);
  if (failure != 0) {
    close(output.read);
    close(complaints.read);
    throw Error(ErrorCode::unwritable, std::string("pullfocus filter cannot be started: ") + std::strerror(failure));
  }
  thread_ = std::thread([this, out = output.read, err = complaints.read] { watch(out, err); });
}

FilterProcess::~FilterProcess() {
  stop();
  thread_.join();
}

void FilterProcess::stop() {
  const std::lock_guard lock(reaping_);
  if (!reaped_) kill(process_, SIGTERM);
}

double FilterProcess::share_done() const noexcept {
  return std::min(1., static_cast<double>(done_) / static_cast<double>(frames_));
}

void FilterProcess::watch(int output, int complaints) {
  std::array<pollfd, 2> ends{pollfd{output, POLLIN, 0}, pollfd{complaints, POLLIN, 0}};
  std::string text;
  std::array<char, 4096> buffer;
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (poll(ends.data(), ends.size(), -1) < 0) continue;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      const ssize_t n = read(ends[i].fd, buffer.data(), buffer.size());
      if (n <= 0) {
        close(ends[i].fd);
        ends[i].fd = -1;
      } else if (i == 0) {
        done_ += static_cast<std::size_t>(std::count(buffer.begin(), buffer.begin() + n, '\n'));
        on_change_();
      } else {
        text.append(buffer.data(), static_cast<std::size_t>(n));
      }
    }
  }
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOWAIT);
  int status = 0;
  {
    const std::lock_guard lock(reaping_);
    waitpid(process_, &status, 0);
    reaped_ = true;
  }
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  error_ = text.substr(text.rfind('\n') + 1);
  over_ = true;
  on_change_();
}

}  // namespace pullfocus::cli::preview
