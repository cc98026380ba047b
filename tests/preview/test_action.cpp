// Actions as lines of text.
#include <gtest/gtest.h>

#include <random>

#include "image/error.h"
#include "preview/action.h"

namespace pullfocus::cli::preview {
namespace {

TEST(Actions, OfAnyWordsComeBackFromTheirLine) {
  std::mt19937 random(1);
  const std::string characters = "ab1.-,:#\"\\ \t'@%";
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < 1000; ++i) {
    Action action{"verb", {}};
    for (std::size_t n = below(4); n > 0; --n) {
      std::string word;
      for (std::size_t k = below(6); k > 0; --k) word += characters[below(characters.size())];
      action.arguments.push_back(word);
    }
    EXPECT_EQ(parse_action(to_line(action)), action) << to_line(action);
  }
}

TEST(Actions, AreSeparatedByBlanksAndEndAtAComment) {
  EXPECT_EQ(parse_action("  key focus\t12 # here\r"), (Action{"key", {"focus", "12"}}));
  EXPECT_EQ(parse_action("export \"my shot.exr\""), (Action{"export", {"my shot.exr"}}));
  EXPECT_EQ(parse_action("export shot#1.exr"), (Action{"export", {"shot#1.exr"}}));
  EXPECT_EQ(parse_action("   # nothing").verb, "");
  EXPECT_EQ(parse_action("").verb, "");
}

TEST(Actions, WithAnOpenQuoteAreRefused) { EXPECT_THROW(parse_action("export \"a b"), Error); }

}  // namespace
}  // namespace pullfocus::cli::preview
