// Values of a TOML file with errors that name file, line and entry.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "camera/keys.h"

namespace pullfocus::sequences {

// A node with its place, as the beginning of a message.
struct Entry {
  const toml::node& node;
  std::string where;

  [[noreturn]] void refuse(std::string_view message) const;  // throws Error(usage)

  std::string text() const;
  double number(double low, double high) const;
  int whole(int low, int high) const;
  bool flag() const;
  glm::vec3 vector(float low, float high) const;
  std::vector<std::string> texts() const;
  std::vector<int> wholes(std::size_t count, int low, int high) const;
  KeyedValue keyed(Infinity infinity) const;  // a number or [frame, value] keys
  std::vector<Entry> list() const;            // elements of an array
};

// Hands every entry of a table to the reader of its name; refuses entries that have none.
using Readers = std::map<std::string_view, std::function<void(const Entry&)>>;
void read_table(const toml::table& table, const std::string& file, const Readers& readers);
void read_table(const Entry& entry, const std::string& file, const Readers& readers);

}  // namespace pullfocus::sequences
