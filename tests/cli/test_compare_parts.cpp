// Parts of pullfocus compare: lists, limits, plots, encodings.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compare/combinations.h"
#include "compare/continuous.h"
#include "compare/plot.h"
#include "compare/results.h"
#include "compare/thumbnails.h"
#include "image/error.h"
#include "strict_xml.h"

namespace pullfocus::cli {
namespace {

using test::xml_problem;

TEST(CompareParts, Base64IsThatOfRfc4648) {
  const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : cases) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(CompareParts, ListsSplitAtSemicolonsIfThereAreAny) {
  using Strings = std::vector<std::string>;
  EXPECT_EQ(split_list("a,b", "--x"), (Strings{"a", "b"}));
  EXPECT_EQ(split_list("none;layers:-2,2", "--x"), (Strings{"none", "layers:-2,2"}));
  EXPECT_EQ(split_list("layers:-2,2;", "--x"), (Strings{"layers:-2,2"}));
  for (const char* wrong : {"", ",", "a,", ",a", "a;;b", "a,a"}) EXPECT_THROW(split_list(wrong, "--x"), Error) << wrong;
}

TEST(CompareParts, CombinationsAreGroupsWithTheirLinearFilterFirstAndNoneTwice) {
  CombinationLists lists;
  lists.budgets = "5%,100%,30ms";
  lists.orders = "gain,fearing";
  lists.coc_steps = "0,0.1";
  const auto groups = combinations({}, lists);
  ASSERT_EQ(groups.size(), 2u);
  for (const Group& group : groups) {
    ASSERT_EQ(group.size(), 1u + 2 + 1 + 2);
    EXPECT_EQ(group[0].method, "linear");
    EXPECT_EQ(group[1].order, "gain");
    EXPECT_EQ(group[2].order, "fearing");
    EXPECT_EQ(group[3].budget, "100%");
    for (const FilterArguments& filter : group) EXPECT_EQ(filter.coc_step, group[0].coc_step);
  }
  EXPECT_EQ(groups[1][0].coc_step, 0.1);
  lists.budgets = "1";
  for (int i = 2; i < 60; ++i) lists.budgets->append(",").append(std::to_string(i));
  EXPECT_THROW(combinations({}, lists), Error);
}

TEST(CompareParts, TicksAreRoundNumbersInRange) {
  EXPECT_EQ(ticks(0, 10, false), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(0.9, 3.1, false, 1), (std::vector<double>{1, 2, 3}));
  for (const auto& [low, high] : {std::pair{0.013, 0.021}, {-3., 5.}, {1e3, 1.7e5}, {99.5, 100.5}}) {
    const auto values = ticks(low, high, false);
    EXPECT_GE(values.size(), 3u);
    EXPECT_LE(values.size(), 8u);
    for (const double value : values) EXPECT_TRUE(value >= low - 1e-9 && value <= high * (1 + 1e-9)) << value;
  }
  EXPECT_EQ(ticks(0.5, 20, true).size(), 6u);  // .5 1 2 5 10 20
  EXPECT_EQ(ticks(1e-9, 1e9, true).size(), 7u);
}

TEST(CompareParts, PlotsAreWellFormedWhateverTheyHold) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<std::pair<double, double>>> data{{},
                                                                 {{1, 0}},
                                                                 {{1, 1}},
                                                                 {{3, 0}, {3, 0}},
                                                                 {{1, infinity}, {2, std::nan("")}},
                                                                 {{1, 1e-300}, {2, 1e300}},
                                                                 {{-5, -3}, {5, 7}}};
  for (const auto& points : data) {
    for (const bool logarithmic : {false, true}) {
      for (std::size_t style = 0; style < 40; style += 9) {
        const std::string text = svg(
            {"a < b & \"c\"", {"x", false, true}, {"y", logarithmic}, {{"one\n\x01", style, points, true}}, points});
        EXPECT_EQ(xml_problem(text), "") << text;
        EXPECT_EQ(text.find("nan"), std::string::npos) << text;
        EXPECT_EQ(text.find("inf"), std::string::npos) << text;
      }
    }
  }
}

TEST(CompareParts, TheFrontHoldsWhatNothingBeats) {
  using Points = std::vector<std::pair<double, double>>;
  const Points points{{3, 1}, {1, 5}, {2, 5}, {2, 3}, {4, 1}, {5, 0}, {1, 7}};
  EXPECT_EQ(pareto(points, false), (Points{{1, 5}, {2, 3}, {3, 1}, {5, 0}}));
  EXPECT_EQ(pareto(points, true), (Points{{1, 7}}));
  EXPECT_EQ(pareto({}, true), Points{});
}

TEST(CompareParts, EscapedTextIsValidUtf8WithoutMarkup) {
  EXPECT_EQ(escaped("a<b>&\"\xc3\xa9\n"), "a&lt;b&gt;&amp;&quot;\xc3\xa9?");
  EXPECT_EQ(escaped("\xff\xc3 \xe2\x82\xac"), "?? \xe2\x82\xac");
  EXPECT_EQ(escaped("\xed\xa0\x80\xc0\x80"), std::string(5, '?'));  // a surrogate, an overlong zero
}

TEST(CompareParts, TheContinuousTableGrowsAndGivesWhatAFullOneGives) {
  const Window w{0, 0, 40, 20};
  FilterOptions options;
  options.kernel.max_coc_px = 60;
  ContinuousFilter growing("disc", "none", w, options);
  options.kernel.coc_step = 0;
  options.kernel.smallest_step = 1. / 8;
  const auto full = make_linear_filter(w, options);
  const CocFunction coc = coc_function({}, {40, 20, 1}, DepthKind::coc);
  Frame frame{ColourImage(w, SampleType::float32), Plane(w, 0), true};
  for (const float largest : {3.3f, 17.7f, 2.f, 45.f, 300.f}) {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 40; ++x) {
        for (int c = 0; c < 4; ++c) frame.colour.set(x, y, c, static_cast<float>((x * 7 + y * 13 + c) % 11) / 11);
        frame.depth.at(x, y) = largest * static_cast<float>(x - 20) / 20;
      }
    }
    full->filter(frame, coc);
    EXPECT_TRUE(growing.filter(frame, coc) == full->result()) << largest;
  }
}

}  // namespace
}  // namespace pullfocus::cli
