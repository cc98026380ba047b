// Enumerators by the names that options and files give them.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "image/error.h"

namespace pullfocus {

template <class Enum>
struct Named {
  Enum value;
  std::string_view name;
};

template <class Enum, std::size_t count>
std::string_view name_in(const Named<Enum> (&table)[count], Enum value) noexcept {
  for (const auto& entry : table)
    if (entry.value == value) return entry.name;
  return "?";
}

// Throws Error(usage) that begins with `where` and lists the legal names.
template <class Enum, std::size_t count>
Enum parse_name(const Named<Enum> (&table)[count], std::string_view text, std::string_view where) {
  std::string legal;
  for (const auto& entry : table) {
    if (entry.name == text) return entry.value;
    legal += fmt::format("{}{}", legal.empty() ? "" : ", ", entry.name);
  }
  throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not one of {}", where, text, legal));
}

}  // namespace pullfocus
