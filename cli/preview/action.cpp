#include "preview/action.h"

#include "image/error.h"

namespace pullfocus::cli::preview {

Action parse_action(std::string_view line) {
  std::vector<std::string> words;
  std::size_t i = 0;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (true) {
    while (i < line.size() && is_blank(line[i])) ++i;
    if (i == line.size() || line[i] == '#') break;
    std::string word;
    if (line[i] == '"') {
      for (++i; i < line.size() && line[i] != '"'; ++i) {
        if (line[i] == '\\' && i + 1 < line.size()) ++i;
        word += line[i];
      }
      if (i == line.size()) throw Error(ErrorCode::usage, "a quote is not closed: " + std::string(line));
      ++i;
    } else {
      while (i < line.size() && !is_blank(line[i])) word += line[i++];
    }
    words.push_back(std::move(word));
  }
  Action action;
  if (words.empty()) return action;
  action.verb = std::move(words.front());
  action.arguments.assign(std::make_move_iterator(words.begin() + 1), std::make_move_iterator(words.end()));
  return action;
}

std::string to_line(const Action& action) {
  std::string line = action.verb;
  for (const std::string& argument : action.arguments) {
    line += ' ';
    if (!argument.empty() && argument.front() != '#' && argument.find_first_of(" \t\r\"\\") == std::string::npos) {
      line += argument;
      continue;
    }
    line += '"';
    for (const char c : argument) {
      if (c == '"' || c == '\\') line += '\\';
      line += c;
    }
    line += '"';
  }
  return line;
}

}  // namespace pullfocus::cli::preview
