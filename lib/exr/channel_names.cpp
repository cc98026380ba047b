#include "exr/channel_names.h"

#include <fmt/format.h>

#include <algorithm>

namespace pullfocus::exr {

std::string_view layer_of(std::string_view channel) noexcept {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : channel.substr(0, dot);
}

std::string_view base_of(std::string_view name) noexcept {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

std::string join_name(std::string_view layer, std::string_view base) {
  return layer.empty() ? std::string(base) : fmt::format("{}.{}", layer, base);
}

bool ends_in(std::string_view layer, std::string_view ending) noexcept {
  if (ending.empty() || !layer.ends_with(ending)) return false;
  return layer.size() == ending.size() || layer[layer.size() - ending.size() - 1] == '.';
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string list_names(const std::vector<std::string>& names) {
  constexpr std::size_t limit = 40;
  const std::size_t shown = std::min(names.size(), limit);
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

}  // namespace pullfocus::exr
