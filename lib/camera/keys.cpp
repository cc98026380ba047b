#include "camera/keys.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "camera/names.h"

namespace pullfocus {
namespace {

constexpr Named<FocusInterp> interpolations[] = {
    {FocusInterp::dioptre, "dioptre"}, {FocusInterp::distance, "distance"}, {FocusInterp::smooth, "smooth"}};

template <class... Args>
[[noreturn]] void refuse(std::string_view where, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(ErrorCode::usage, fmt::format("{}: {}", where, fmt::format(format, std::forward<Args>(args)...)));
}

// Also refuses values so small that their inverse is not finite.
void check_value(double value, std::string_view where, Infinity infinity) {
  if (value == std::numeric_limits<double>::infinity()) {
    if (infinity == Infinity::legal) return;
    refuse(where, "must be finite, not {}", value);
  }
  if (!(value > 0 && std::isfinite(1 / value))) refuse(where, "must be a positive number, not {}", value);
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

template <class Number>
Number parse_number(std::string_view text, std::string_view where, const char* what) {
  text = trim(text);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) refuse(where, "{} '{}' is out of range", what, text);
  if (error != std::errc{} || end != text.data() + text.size())
    refuse(where, "'{}' is not a {}; write VALUE or FRAME:VALUE,FRAME:VALUE,...", text, what);
  return number;
}

Key parse_key(std::string_view text, std::string_view where) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos)
    refuse(where, "'{}' is not a key; write VALUE or FRAME:VALUE,FRAME:VALUE,...", trim(text));
  return {parse_number<int>(text.substr(0, colon), where, "whole frame number"),
          parse_number<double>(text.substr(colon + 1), where, "number")};
}

double mix(double from, double to, double share) { return from * (1 - share) + to * share; }

// share of the way from a to b, in (0, 1).
double between(double a, double b, double share, FocusInterp interpolation) {
  if (a == b) return a;
  if (interpolation == FocusInterp::smooth) share = share * share * (3 - 2 * share);
  const double value = interpolation == FocusInterp::distance ? mix(a, b, share) : 1 / mix(1 / a, 1 / b, share);
  return std::clamp(value, std::min(a, b), std::max(a, b));  // rounding may not overshoot a key
}

double value_at(const std::vector<Key>& keys, int frame, FocusInterp interpolation) {
  const auto next =
      std::upper_bound(keys.begin(), keys.end(), frame, [](int wanted, const Key& key) { return wanted < key.frame; });
  if (next == keys.begin()) return keys.front().value;
  const Key& last = *std::prev(next);
  if (next == keys.end() || last.frame == frame) return last.value;
  const double span = static_cast<double>(next->frame) - last.frame;
  return between(last.value, next->value, (static_cast<double>(frame) - last.frame) / span, interpolation);
}

}  // namespace

std::string_view name(FocusInterp interpolation) noexcept { return name_in(interpolations, interpolation); }

FocusInterp parse_focus_interp(std::string_view text, std::string_view where) {
  return parse_name(interpolations, text, where);
}

KeyedValue::KeyedValue(double value, std::string_view where, Infinity infinity)
    : keys_{Key{0, value}}, constant_(true) {
  check_value(value, where, infinity);
}

KeyedValue::KeyedValue(std::vector<Key> keys, std::string_view where, Infinity infinity) : keys_(std::move(keys)) {
  if (keys_.empty()) refuse(where, "has no keys; give at least one FRAME:VALUE");
  for (const Key& key : keys_) check_value(key.value, where, infinity);
  std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) { return a.frame < b.frame; });
  const auto twice =
      std::adjacent_find(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) { return a.frame == b.frame; });
  if (twice != keys_.end()) refuse(where, "has two keys for frame {}", twice->frame);
}

KeyedValue KeyedValue::parse(std::string_view text, std::string_view where, Infinity infinity) {
  if (text.find_first_of(":,") == std::string_view::npos)
    return {parse_number<double>(text, where, "number"), where, infinity};
  std::vector<Key> keys;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = text.find(',');
    keys.push_back(parse_key(text.substr(0, comma), where));
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
  return {std::move(keys), where, infinity};
}

std::string KeyedValue::to_string() const {
  if (constant_) return fmt::format("{}", keys_.front().value);
  std::string text;
  for (const Key& key : keys_) text += fmt::format("{}{}:{}", text.empty() ? "" : ",", key.frame, key.value);
  return text;
}

double KeyedValue::linear_at(int frame) const { return value_at(keys_, frame, FocusInterp::distance); }

double KeyedValue::focus_at(int frame, FocusInterp interpolation) const {
  const bool infinite = std::any_of(keys_.begin(), keys_.end(), [](const Key& key) { return std::isinf(key.value); });
  if (infinite && keys_.size() > 1 && interpolation == FocusInterp::distance)
    refuse("--focus-interp", "distance cannot reach a focus key at infinity; use dioptre or smooth");
  return value_at(keys_, frame, interpolation);
}

}  // namespace pullfocus
