#include "key_file.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <fstream>
#include <iterator>
#include <limits>

#include "image/error.h"

namespace pullfocus {
namespace {

// Where a value stands, as the beginning of a message.
std::string place(std::string_view file, const toml::source_region& source, std::string_view what) {
  return fmt::format("{}:{}: {}", file, source.begin.line, what);
}

[[noreturn]] void refuse(const std::string& where, std::string_view message) {
  throw Error(ErrorCode::usage, fmt::format("{}: {}", where, message));
}

// Of a node that is a number. toml++ itself has no value for whole numbers beyond 2^53.
double number_of(const toml::node& node) {
  const auto* whole = node.as_integer();
  return whole ? static_cast<double>(whole->get()) : node.as_floating_point()->get();
}

Key read_key(const toml::node& node, const std::string& where) {
  const toml::array* pair = node.as_array();
  if (!pair || pair->size() != 2 || !(*pair)[0].is_integer() || !(*pair)[1].is_number())
    refuse(where, "each key must be [frame, value] with a whole frame number");
  const std::int64_t frame = (*pair)[0].as_integer()->get();
  using Limits = std::numeric_limits<int>;
  if (frame < Limits::min() || frame > Limits::max()) refuse(where, "frame number is out of range");
  return {static_cast<int>(frame), number_of((*pair)[1])};
}

KeyedValue read_setting(const toml::node& node, std::string_view file, std::string_view what, Infinity infinity) {
  const std::string where = place(file, node.source(), what);
  if (node.is_number()) return {number_of(node), where, infinity};
  const toml::array* list = node.as_array();
  if (!list) refuse(where, "must be a number or a list of [frame, value] keys");
  std::vector<Key> keys;
  for (const toml::node& key : *list) keys.push_back(read_key(key, place(file, key.source(), what)));
  return {std::move(keys), where, infinity};
}

FocusInterp read_interpolation(const toml::node& node, std::string_view file) {
  const std::string where = place(file, node.source(), "interpolation");
  if (!node.is_string()) refuse(where, "must be \"dioptre\", \"distance\" or \"smooth\"");
  return parse_focus_interp(node.as_string()->get(), where);
}

CameraKeys read_table(const toml::table& table, std::string_view file) {
  CameraKeys keys;
  for (const auto& [key, node] : table) {
    const std::string_view what = key.str();
    if (what == "interpolation")
      keys.interpolation = read_interpolation(node, file);
    else if (what == "focus")
      keys.focus = read_setting(node, file, what, Infinity::legal);
    else if (what == "fstop")
      keys.fstop = read_setting(node, file, what, Infinity::refused);
    else if (what == "focal_length")
      keys.focal_length = read_setting(node, file, what, Infinity::refused);
    else
      refuse(place(file, key.source(), what), "is none of interpolation, focus, fstop, focal_length");
  }
  return keys;
}

std::string setting_text(std::string_view what, const std::optional<KeyedValue>& setting) {
  if (!setting) return {};
  if (setting->is_constant()) return fmt::format("{} = {}\n", what, setting->keys().front().value);
  std::string list;
  for (const Key& key : setting->keys())
    list += fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", key.frame, key.value);
  return fmt::format("{} = [{}]\n", what, list);
}

}  // namespace

CameraKeys load_camera_keys(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw Error(ErrorCode::unreadable, fmt::format("{}: cannot be read; give a file of camera keys", file.string()));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  try {
    return read_table(toml::parse(text, file.string()), file.string());
  } catch (const toml::parse_error& error) {
    refuse(place(file.string(), error.source(), "not TOML"), error.description());
  }
}

void save_camera_keys(const CameraKeys& keys, const std::filesystem::path& file) {
  std::filesystem::path draft = file;
  draft += ".temp";
  std::ofstream out(draft, std::ios::binary);
  out << fmt::format("interpolation = \"{}\"\n", name(keys.interpolation)) << setting_text("focus", keys.focus)
      << setting_text("fstop", keys.fstop) << setting_text("focal_length", keys.focal_length);
  out.close();
  std::error_code failure;
  if (out) std::filesystem::rename(draft, file, failure);
  if (out && !failure) return;
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);
  throw Error(ErrorCode::unwritable, fmt::format("{}: cannot be written", file.string()));
}

}  // namespace pullfocus
