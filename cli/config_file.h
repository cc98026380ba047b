// --config FILE: any option of a subcommand from a TOML file.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace pullfocus::cli {

// Declares --config, for the help text; expand_config() has taken it out of the arguments before they are
// parsed.
void add_config_option(CLI::App& app);

// Puts `--key=value` for every entry of the named TOML files right after the subcommand's name, so that
// options on the command line, which come later, win. `true` gives a bare flag, `false` nothing; arrays are
// joined by commas. Throws Error(usage) for a missing or malformed file, or a value that no option can take.
std::vector<std::string> expand_config(const std::vector<std::string>& arguments);

}  // namespace pullfocus::cli
