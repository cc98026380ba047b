#include "exr/range.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <unordered_set>

#include "image/error.h"

namespace pullfocus::exr {
namespace {

constexpr std::int64_t max_frames = 10'000'000;

[[noreturn]] void fail(std::string_view text, const std::string& reason) {
  throw Error(ErrorCode::usage, fmt::format("frame range '{}': {} (write it like 1-10,20-40x2)", text, reason));
}

struct Term {
  std::int64_t first = 0, last = 0, step = 1;
  bool complement = false;

  std::int64_t span() const { return std::abs(last - first) + 1; }
};

// Takes pieces off the front of one term.
class TermParser {
 public:
  TermParser(std::string_view text, std::string_view term) : text_(text), rest_(term) {}

  Term parse() {
    Term term;
    term.first = term.last = number();
    if (take('-')) {
      term.last = number();
      parse_step(term);
    }
    if (!rest_.empty()) fail(text_, fmt::format("cannot make sense of '{}'", rest_));
    return term;
  }

 private:
  void parse_step(Term& term) {
    if (take('y')) {
      term.complement = true;
    } else if (!take('x')) {
      return;
    }
    term.step = number();
    if (term.step < 1) fail(text_, "a step must be 1 or more");
  }

  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  int number() {
    int value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error == std::errc::result_out_of_range) fail(text_, "a number is too large");
    if (error != std::errc{}) fail(text_, "a frame number is missing");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  std::string_view text_, rest_;
};

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::vector<Term> parse_terms(std::string_view text) {
  std::vector<Term> terms;
  std::int64_t total = 0;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::string_view piece = trim(text.substr(start, comma - start));
    if (piece.empty()) fail(text, text.empty() ? "it is empty" : "an entry is empty");
    terms.push_back(TermParser(text, piece).parse());
    total += terms.back().span();
    if (total > max_frames) fail(text, fmt::format("more than {} frames", max_frames));
    start = comma + 1;
  }
  return terms;
}

void append(const Term& term, std::vector<int>& frames) {
  const int direction = term.last < term.first ? -1 : 1;
  for (std::int64_t i = 0; i < term.span(); ++i) {
    const bool on_step = i % term.step == 0;
    if (on_step != term.complement) frames.push_back(static_cast<int>(term.first + direction * i));
  }
}

// Number of leading frames from `begin` on with one constant step.
std::size_t run_length(const std::vector<int>& frames, std::size_t begin, std::int64_t step) {
  std::size_t count = 1;
  while (begin + count < frames.size() && std::int64_t{frames[begin + count]} - frames[begin + count - 1] == step) {
    ++count;
  }
  return count;
}

}  // namespace

std::vector<int> parse_frames(std::string_view text) {
  const std::vector<Term> terms = parse_terms(text);
  std::vector<int> frames;
  for (const Term& term : terms) append(term, frames);
  if (frames.empty()) fail(text, "it holds no frame");
  if (terms.size() > 1) {
    std::unordered_set<int> seen;
    std::erase_if(frames, [&](int frame) { return !seen.insert(frame).second; });
  }
  return frames;
}

std::string format_frames(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    const std::int64_t step = i + 1 < frames.size() ? std::int64_t{frames[i + 1]} - frames[i] : 0;
    const std::size_t count = step == 0 ? 1 : run_length(frames, i, step);
    const bool consecutive = std::abs(step) == 1;
    if (!text.empty()) text += ',';
    if (count < 2 || (count == 2 && !consecutive)) {
      text += fmt::format("{}", frames[i++]);
      continue;
    }
    text += fmt::format("{}-{}", frames[i], frames[i + count - 1]);
    if (!consecutive) text += fmt::format("x{}", std::abs(step));
    i += count;
  }
  return text;
}

}  // namespace pullfocus::exr
