// What a command asks of the process it runs in.
#include <OpenEXR/ImfThreading.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <memory>

#include "command.h"

namespace pullfocus::cli {

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int) {
  stop_requested = true;
  // A second signal ends the program at once.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void use_threads(int threads, int waiting) {
  if (threads == 0) threads = tbb::info::default_concurrency();
  static std::unique_ptr<tbb::global_control> control;
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads + waiting));
  // One thread decodes in the calling thread: OpenEXR counts only helpers.
  Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
}

bool interrupted() noexcept { return stop_requested; }

void warn(const std::string& message) { std::fprintf(stderr, "pullfocus: warning: %s\n", message.c_str()); }

}  // namespace pullfocus::cli
