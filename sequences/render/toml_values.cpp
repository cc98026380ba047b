#include "render/toml_values.h"

#include <fmt/format.h>

#include <limits>

#include "image/error.h"

namespace pullfocus::sequences {
namespace {

// Of a node that is a number. toml++ itself has no value for whole numbers beyond 2^53.
double number_of(const toml::node& node) {
  const auto* whole = node.as_integer();
  return whole ? static_cast<double>(whole->get()) : node.as_floating_point()->get();
}

}  // namespace

void Entry::refuse(std::string_view message) const {
  throw Error(ErrorCode::usage, fmt::format("{} {}", where, message));
}

std::string Entry::text() const {
  if (!node.is_string()) refuse("must be a text in quotes");
  return node.as_string()->get();
}

double Entry::number(double low, double high) const {
  if (!node.is_number()) refuse("must be a number");
  const double value = number_of(node);
  if (!(value >= low && value <= high)) refuse(fmt::format("must lie between {} and {}", low, high));
  return value;
}

int Entry::whole(int low, int high) const {
  if (!node.is_integer()) refuse("must be a whole number");
  return static_cast<int>(number(low, high));
}

bool Entry::flag() const {
  if (!node.is_boolean()) refuse("must be true or false");
  return node.as_boolean()->get();
}

std::vector<Entry> Entry::list() const {
  const toml::array* array = node.as_array();
  if (!array) refuse("must be a list");
  std::vector<Entry> entries;
  for (const toml::node& element : *array) entries.push_back({element, where});
  return entries;
}

glm::vec3 Entry::vector(float low, float high) const {
  const std::vector<Entry> entries = list();
  if (entries.size() != 3) refuse("must be a list of three numbers");
  glm::vec3 result(0);
  for (int i = 0; i < 3; ++i)
    result[i] = static_cast<float>(
        entries[static_cast<std::size_t>(i)].number(static_cast<double>(low), static_cast<double>(high)));
  return result;
}

std::vector<std::string> Entry::texts() const {
  std::vector<std::string> result;
  for (const Entry& entry : list()) result.push_back(entry.text());
  return result;
}

std::vector<int> Entry::wholes(std::size_t count, int low, int high) const {
  std::vector<int> result;
  for (const Entry& entry : list()) result.push_back(entry.whole(low, high));
  if (result.size() != count) refuse(fmt::format("must be a list of {} whole numbers", count));
  return result;
}

KeyedValue Entry::keyed(Infinity infinity) const {
  if (node.is_number()) return {number_of(node), where, infinity};
  std::vector<Key> keys;
  for (const Entry& pair : list()) {
    const std::vector<Entry> parts = pair.list();
    if (parts.size() != 2 || !parts[1].node.is_number()) refuse("must be a number or a list of [frame, value] keys");
    using Limits = std::numeric_limits<int>;
    keys.push_back({parts[0].whole(Limits::min(), Limits::max()), number_of(parts[1].node)});
  }
  return {std::move(keys), where, infinity};
}

void read_table(const toml::table& table, const std::string& file, const Readers& readers) {
  for (const auto& [key, node] : table) {
    const Entry entry{node, fmt::format("{}:{}: {}", file, key.source().begin.line, key.str())};
    const auto reader = readers.find(key.str());
    if (reader == readers.end()) {
      std::string known;
      for (const auto& [name, read] : readers) known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
      entry.refuse("is none of " + known);
    }
    reader->second(entry);
  }
}

void read_table(const Entry& entry, const std::string& file, const Readers& readers) {
  const toml::table* table = entry.node.as_table();
  if (!table) entry.refuse("must be a table");
  read_table(*table, file, readers);
}

}  // namespace pullfocus::sequences
