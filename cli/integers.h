// Whole numbers with given characters between them.
#pragma once

#include <charconv>
#include <initializer_list>
#include <string_view>

namespace pullfocus::cli {

// Reads "N", "NxN", "N,N@N", ...: as many numbers as there are `values`, one of `separators` between each two, nothing
// else. False if the text is anything else or a number is beyond int; values may then have changed.
inline bool read_integers(std::string_view text, std::string_view separators, std::initializer_list<int*> values) {
  const char* next = text.data();
  const char* const end = next + text.size();
  auto separator = separators.begin();
  for (int* value : values) {
    if (value != *values.begin() && (next == end || *next++ != *separator++)) return false;
    const auto [stop, error] = std::from_chars(next, end, *value);
    if (error != std::errc{}) return false;
    next = stop;
  }
  return next == end;
}

}  // namespace pullfocus::cli
