// Subcommands: each file defines one, and main() collects them.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace pullfocus::cli {

// Exit codes of the program.
inline constexpr int kDone = 0, kFrameFailed = 1, kWrongUsage = 2;

// Adds a subcommand's options to `app`; the returned function runs it after parsing and gives the exit code.
// It may throw pullfocus::Error.
using Run = std::function<int()>;
Run add_bench_command(CLI::App& app);
Run add_filter_command(CLI::App& app);
Run add_compare_command(CLI::App& app);
Run add_inspect_command(CLI::App& app);
Run add_preview_command(CLI::App& app);
Run add_render_command(CLI::App& app);

// Gives `threads` threads (0: one a processor) to everything that computes in parallel, and as many to OpenEXR, until
// the program ends or the next call. `waiting`: threads beside them that mostly wait for files or for OpenEXR's.
void use_threads(int threads, int waiting = 0);

// True once the user or the system asked the program to end (SIGINT, SIGTERM): finish the frame at hand, then
// stop.
bool interrupted() noexcept;

// One line on stderr: "pullfocus: warning: ...".
void warn(const std::string& message);

}  // namespace pullfocus::cli
