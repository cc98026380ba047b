#include "strict_xml.h"

#include <algorithm>
#include <regex>
#include <set>
#include <vector>

namespace pullfocus::test {

namespace {

const std::string kNameCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-:_";

std::string bad_entity(const std::string& text) {
  static const std::regex entity("&(amp|lt|gt|quot|apos|#[0-9]+|#x[0-9a-fA-F]+);");
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
    const std::string next = text.substr(at, 12);
    if (!std::regex_search(next, entity, std::regex_constants::match_continuous)) return "stray & before: " + next;
  }
  return "";
}

// Attributes of a tag, from `at` to its end.
std::string bad_attributes(const std::string& tag, std::size_t at) {
  std::set<std::string> names;
  while (true) {
    const std::size_t begin = tag.find_first_not_of(" \n", at);
    if (begin == std::string::npos) return "";
    if (begin == at) return "no space before an attribute: " + tag.substr(0, 60);
    const std::size_t end = tag.find_first_not_of(kNameCharacters, begin);
    if (end == std::string::npos || end == begin || tag.compare(end, 2, "=\"") != 0)
      return "attribute without a quoted value: " + tag.substr(0, 60);
    if (!names.insert(tag.substr(begin, end - begin)).second) return "attribute twice: " + tag.substr(0, 60);
    const std::size_t close = tag.find('"', end + 2);
    if (close == std::string::npos) return "open quote: " + tag.substr(0, 60);
    const std::string problem = bad_entity(tag.substr(end + 2, close - end - 2));
    if (!problem.empty()) return problem;
    at = close + 1;
  }
}

}  // namespace

std::string xml_problem(const std::string& text) {
  const auto control =
      std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n'; });
  if (control != text.end()) return "control character";
  std::size_t at = text.starts_with("<!DOCTYPE html>\n") ? 16 : 0;
  std::vector<std::string> open;
  bool root_done = false;
  while (at < text.size()) {
    const std::size_t less = std::min(text.find('<', at), text.size());
    const std::string between = text.substr(at, less - at);
    if (open.empty() && between.find_first_not_of(" \n") != std::string::npos) return "text outside the root";
    if (const std::string problem = bad_entity(between); !problem.empty()) return problem;
    if (less == text.size()) break;
    const std::size_t greater = text.find('>', less);
    if (greater == std::string::npos) return "open tag at the end";
    std::string tag = text.substr(less + 1, greater - less - 1);
    at = greater + 1;
    if (tag.find('<') != std::string::npos) return "< inside a tag: " + tag.substr(0, 60);
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) return "closes what is not open: " + tag;
      open.pop_back();
      root_done |= open.empty();
      continue;
    }
    const bool alone = tag.ends_with('/');
    if (alone) tag.pop_back();
    const std::size_t end = std::min(tag.find_first_not_of(kNameCharacters), tag.size());
    if (end == 0) return "tag without a name: " + tag.substr(0, 60);
    if (open.empty() && root_done) return "second root";
    if (const std::string problem = bad_attributes(tag, end); !problem.empty()) return problem;
    if (!alone) open.push_back(tag.substr(0, end));
  }
  if (!open.empty()) return "never closed: " + open.back();
  return root_done ? "" : "no root";
}

}  // namespace pullfocus::test
