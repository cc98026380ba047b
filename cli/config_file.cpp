#include "config_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "image/error.h"

namespace pullfocus::cli {

namespace {

std::string value_text(const toml::node& node, const std::string& where) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* array = node.as_array()) {
    std::string joined;
    for (const toml::node& element : *array) joined += (joined.empty() ? "" : ",") + value_text(element, where);
    return joined;
  }
  throw Error(ErrorCode::usage, where + " must be a text, a number, true, false, or a list of texts and numbers");
}

std::vector<std::string> load(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(ErrorCode::usage, fmt::format("--config {}: no such file", path));
  }
  toml::table table;
  try {
    table = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorCode::usage,
                fmt::format("--config {}:{}: {}", path, error.source().begin.line, error.description()));
  }
  std::vector<std::string> options;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (const auto* flag = node.as_boolean()) {
      if (flag->get()) options.push_back("--" + name);
      continue;
    }
    options.push_back(fmt::format("--{}={}", name, value_text(node, fmt::format("--config {}: {}", path, name))));
  }
  return options;
}

}  // namespace

void add_config_option(CLI::App& app) {
  app.add_option("--config", "TOML file with any of these options, without the dashes; the command line wins")
      ->type_name("FILE");
}

std::vector<std::string> expand_config(const std::vector<std::string>& arguments) {
  std::vector<std::string> from_files, rest;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    std::string path;
    if (argument.starts_with("--config=")) {
      path = argument.substr(9);
    } else if (argument == "--config") {
      if (i + 1 == arguments.size()) throw Error(ErrorCode::usage, "--config needs a file name");
      path = arguments[++i];
    } else {
      rest.push_back(argument);
      continue;
    }
    const std::vector<std::string> options = load(path);
    from_files.insert(from_files.end(), options.begin(), options.end());
  }
  rest.insert(rest.begin() + (rest.empty() ? 0 : 1), from_files.begin(), from_files.end());
  return rest;
}

}  // namespace pullfocus::cli
