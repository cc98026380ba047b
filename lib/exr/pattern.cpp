#include "exr/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "exr/range.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

namespace fs = std::filesystem;

constexpr int max_digits = 20;
constexpr std::string_view decimal_digits = "0123456789";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Placeholder {
  std::size_t begin, end;
  int digits;
  bool printf_style;
};

[[noreturn]] void fail(std::string_view text, std::string_view reason) {
  throw Error(ErrorCode::usage, fmt::format("{}: {}; write frame numbers as ####, @@@@ or %04d", text, reason));
}

std::optional<Placeholder> find_marks(std::string_view name, std::size_t from) {
  const std::size_t begin = name.find_first_of("#@", from);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of("#@", begin), name.size());
  const auto hashes = std::count(name.begin() + begin, name.begin() + end, '#');
  const auto ats = static_cast<std::ptrdiff_t>(end - begin) - hashes;
  return Placeholder{begin, end, static_cast<int>((hashes == 1 ? 4 : hashes) + ats), false};
}

// A '%' that starts no number is an error: printf would not take it, and file names hardly have any.
std::optional<Placeholder> find_printf(std::string_view text, std::string_view name, std::size_t from) {
  const std::size_t begin = name.find('%', from);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = name.find('d', begin);
  if (end == std::string_view::npos) fail(text, "'%' without a 'd'");
  const std::string_view width = name.substr(begin + 1, end - begin - 1);
  if (width.empty()) return Placeholder{begin, end + 1, 1, true};
  int digits = 0;
  const auto [stop, error] = std::from_chars(width.data(), width.data() + width.size(), digits);
  if (width.front() != '0' || error != std::errc{} || stop != width.data() + width.size()) {
    fail(text, "a malformed '%'");
  }
  return Placeholder{begin, end + 1, std::max(digits, 1), true};
}

std::optional<Placeholder> find_placeholder(std::string_view text, std::string_view name) {
  const auto marks = find_marks(name, 0);
  const auto printf = find_printf(text, name, 0);
  const bool twice =
      (marks && printf) || (marks && find_marks(name, marks->end)) || (printf && find_printf(text, name, printf->end));
  if (twice) fail(text, "more than one placeholder for the frame number");
  const auto found = marks ? marks : printf;
  if (found && found->digits > max_digits) fail(text, "too many digits");
  return found;
}

// Where a frame range such as `1-100` starts that ends the text; npos if none does. A plain number is part of
// the name (`v2#`), and so is a minus sign right after a letter (`shot-1-10#` counts from 1).
std::size_t range_start(std::string_view text) {
  std::size_t start = text.find_last_not_of("0123456789,-xy");
  start = start == std::string_view::npos ? 0 : start + 1;
  for (; start < text.size(); ++start) {
    const bool sign = text[start] == '-' && start + 1 < text.size() && is_digit(text[start + 1]);
    const bool after_separator = start == 0 || text[start - 1] == '.' || text[start - 1] == '_';
    if (is_digit(text[start]) || (sign && after_separator)) break;
  }
  const bool plain_number = text.find_first_of(",-", start + 1) == std::string_view::npos;
  return start >= text.size() || plain_number ? std::string_view::npos : start;
}

}  // namespace

Pattern Pattern::parse(std::string_view text) {
  const std::size_t slash = text.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? text : text.substr(slash + 1);
  if (name.empty()) fail(text.empty() ? "(empty name)" : text, "no file name");

  Pattern pattern;
  pattern.text_ = text;
  pattern.folder_prefix_ = text.substr(0, text.size() - name.size());
  const auto placeholder = find_placeholder(text, name);
  if (!placeholder) {
    pattern.single_ = true;
    pattern.before_ = name;
    return pattern;
  }
  pattern.digits_ = placeholder->digits;
  pattern.before_ = name.substr(0, placeholder->begin);
  pattern.after_ = name.substr(placeholder->end);
  if (placeholder->printf_style) return pattern;

  const std::size_t start = range_start(pattern.before_);
  if (start == std::string::npos) return pattern;
  pattern.range_ = parse_frames(std::string_view(pattern.before_).substr(start));
  pattern.before_.erase(start);
  return pattern;
}

std::string Pattern::path(int frame) const {
  if (single_) return text_;
  return fmt::format("{}{}{:0{}}{}", folder_prefix_, before_, frame, digits_, after_);
}

int Pattern::single_frame() const {
  const std::string_view stem = std::string_view(before_).substr(0, before_.rfind('.'));
  const std::size_t last = stem.find_last_of(decimal_digits);
  if (last == std::string_view::npos) return 1;
  const std::size_t previous = stem.find_last_not_of(decimal_digits, last);
  const std::size_t first = previous == std::string_view::npos ? 0 : previous + 1;
  int frame = 1;
  const auto result = std::from_chars(stem.data() + first, stem.data() + last + 1, frame);
  return result.ec == std::errc{} ? frame : 1;
}

std::string Pattern::folder() const {
  if (folder_prefix_.empty()) return ".";
  return folder_prefix_.size() == 1 ? folder_prefix_ : folder_prefix_.substr(0, folder_prefix_.size() - 1);
}

std::optional<int> Pattern::frame_of(std::string_view name) const {
  if (name.size() <= before_.size() + after_.size()) return std::nullopt;
  if (!name.starts_with(before_) || !name.ends_with(after_)) return std::nullopt;
  const std::string_view number = name.substr(before_.size(), name.size() - before_.size() - after_.size());
  int frame = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), frame);
  if (error != std::errc{} || end != number.data() + number.size()) return std::nullopt;
  // Only the one spelling that path() writes: `7` must not pass for `0007`.
  return fmt::format("{:0{}}", frame, digits_) == number ? std::optional(frame) : std::nullopt;
}

std::vector<int> Pattern::discover() const {
  std::error_code error;
  if (single_) {
    const fs::file_status status = fs::status(text_, error);
    if (!fs::exists(status)) throw Error(ErrorCode::unreadable, fmt::format("{}: no such file", text_));
    if (fs::is_directory(status)) {
      throw Error(ErrorCode::unreadable,
                  fmt::format("{}: is a folder; name its files by a pattern such as {}/name.####.exr", text_, text_));
    }
    return {single_frame()};
  }
  std::vector<int> frames;
  for (fs::directory_iterator entry(folder(), error), end; !error && entry != end; entry.increment(error)) {
    const auto frame = frame_of(entry->path().filename().string());
    if (frame) frames.push_back(*frame);
  }
  if (error) {
    throw Error(ErrorCode::unreadable, fmt::format("{}: cannot list the folder: {}", folder(), error.message()));
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace pullfocus::exr
