#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <vector>

#include "command.h"
#include "config_file.h"
#include "image/error.h"
#include "version.h"

namespace {

using namespace pullfocus;

int run(int argc, char** argv) {
  CLI::App app("Adds depth of field to rendered image sequences, recomputing only what changed.", "pullfocus");
  app.set_version_flag("--version", std::string("pullfocus ") + kVersion);
  app.require_subcommand(1);
  std::map<const CLI::App*, cli::Run> commands;
  const auto add = [&](const char* name, const char* what, cli::Run (*command)(CLI::App&)) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    commands[sub] = command(*sub);
    cli::add_config_option(*sub);
  };
  add("filter", "filter a sequence: RGB + depth EXR in, depth of field out", cli::add_filter_command);
  add("preview", "try focus, aperture and keys on a shot in a window, and export them", cli::add_preview_command);
  add("inspect", "say what a sequence holds, how it is understood and what filtering it will cost",
      cli::add_inspect_command);
  add("compare", "measure speed against error of methods and budgets over sequences", cli::add_compare_command);
  add("render", "make a synthetic RGB + depth sequence", cli::add_render_command);
  add("bench", "measure the filter: the tables of docs/benchmarks.md", cli::add_bench_command);

  try {
    std::vector<std::string> arguments = cli::expand_config({argv + 1, argv + argc});
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them last first
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    std::fprintf(stderr, "pullfocus: %s (see pullfocus %s--help)\n", error.what(),
                 app.get_subcommands().empty() ? "" : (app.get_subcommands()[0]->get_name() + " ").c_str());
    return cli::kWrongUsage;
  }
  return commands.at(app.get_subcommands().front())();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const pullfocus::Error& error) {
    std::fprintf(stderr, "pullfocus: %s\n", error.what());
    return error.code() == pullfocus::ErrorCode::usage ? pullfocus::cli::kWrongUsage : pullfocus::cli::kFrameFailed;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "pullfocus: out of memory: use fewer --threads, less --overscan, or a larger machine\n");
    return pullfocus::cli::kFrameFailed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pullfocus: %s\n", error.what());
    return pullfocus::cli::kFrameFailed;
  }
}
