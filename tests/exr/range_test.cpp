#include "exr/range.h"

#include "exr/exr_files.h"

namespace pullfocus::exr {
namespace {

using Frames = std::vector<int>;

TEST(Range, SingleNumberIsOneFrame) { EXPECT_EQ(parse_frames("12"), Frames{12}); }

TEST(Range, EndsAreInclusive) { EXPECT_EQ(parse_frames("3-6"), (Frames{3, 4, 5, 6})); }

TEST(Range, StepCountsFromTheFirstFrame) { EXPECT_EQ(parse_frames("1-10x4"), (Frames{1, 5, 9})); }

TEST(Range, YIsWhatXLeavesOut) { EXPECT_EQ(parse_frames("1-7y3"), (Frames{2, 3, 5, 6})); }

TEST(Range, BackwardsCountsDown) {
  EXPECT_EQ(parse_frames("4-1"), (Frames{4, 3, 2, 1}));
  EXPECT_EQ(parse_frames("10-1x4"), (Frames{10, 6, 2}));
}

TEST(Range, NegativeNumbersAreFrames) {
  EXPECT_EQ(parse_frames("-3"), Frames{-3});
  EXPECT_EQ(parse_frames("-7--5"), (Frames{-7, -6, -5}));
  EXPECT_EQ(parse_frames("1--1"), (Frames{1, 0, -1}));
}

TEST(Range, ListKeepsOrderAndDropsRepeats) { EXPECT_EQ(parse_frames("5,1-6x2, 3 ,2"), (Frames{5, 1, 3, 2})); }

TEST(Range, ExtremeFrameNumbersAreRead) {
  EXPECT_EQ(parse_frames("2147483646-2147483647"), (Frames{2147483646, 2147483647}));
  EXPECT_EQ(parse_frames("-2147483648"), Frames{-2147483647 - 1});
}

TEST(Range, NonsenseIsAUsageErrorThatQuotesIt) {
  for (const char* text : {"",
                           " ",
                           ",",
                           "1,",
                           "1,,2",
                           "a",
                           "1-",
                           "1-2x",
                           "1-2x0",
                           "1-2x-1",
                           "1-2y0",
                           "1-2z3",
                           "1x2",
                           "1 2",
                           "1-2-3",
                           "--1",
                           "+1",
                           "1.5",
                           "99999999999",
                           "1-99999999999",
                           "1-2147483647",
                           "1-5y1",
                           "0-9999999,1",
                           "-2147483648-2147483647",
                           "1-3x",
                           "0x10"}) {
    SCOPED_TRACE(text);
    test::expect_error(ErrorCode::usage, {std::string("'") + text + "'"}, [&] { parse_frames(text); });
  }
}

TEST(Range, FormatIsCompact) {
  EXPECT_EQ(format_frames({}), "");
  EXPECT_EQ(format_frames({7}), "7");
  EXPECT_EQ(format_frames({1, 2, 3, 7, 20, 22, 24}), "1-3,7,20-24x2");
  EXPECT_EQ(format_frames({3, 2, 1}), "3-1");
  EXPECT_EQ(format_frames({-5, -4, 4}), "-5--4,4");
}

TEST(Range, ParsingWhatFormatWroteGivesTheFramesBack) {
  for (const char* text : {"1", "1-10", "10-1x3", "-5-5", "1,3,5,6,7,100,90,80", "1-100y7", "2147483647,-2147483648"}) {
    const Frames frames = parse_frames(text);
    EXPECT_EQ(parse_frames(format_frames(frames)), frames) << text << " as " << format_frames(frames);
  }
}

}  // namespace
}  // namespace pullfocus::exr
