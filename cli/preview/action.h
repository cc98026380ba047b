// What a user does in the preview, as a line of text: the window's buttons and keys give such lines, scripts are made
// of them, and a recording is a list of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pullfocus::cli::preview {

struct Action {
  std::string verb;
  std::vector<std::string> arguments;
  bool operator==(const Action&) const = default;
};

// Words are separated by blanks; one with blanks or quotes in it, or # before it, stands in double quotes, in which \"
// and \\ are a quote and a backslash. From a # that begins a word on, the rest is a comment. An empty verb: nothing but
// blanks and comment. Throws Error(usage) for an open quote.
Action parse_action(std::string_view line);
std::string to_line(const Action& action);  // what parse_action() turns into an equal action

}  // namespace pullfocus::cli::preview
