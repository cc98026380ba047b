#include "exr/pattern.h"

#include <filesystem>

#include "exr/exr_files.h"
#include "exr/output_names.h"

namespace pullfocus::exr {
namespace {

using Frames = std::vector<int>;

std::string path(const std::string& pattern, int frame) { return Pattern::parse(pattern).path(frame); }

TEST(Pattern, HashesPadToTheirNumberAndALoneOneToFour) {
  EXPECT_EQ(path("a/shot.#.exr", 12), "a/shot.0012.exr");
  EXPECT_EQ(path("shot.##.exr", 7), "shot.07.exr");
  EXPECT_EQ(path("shot.######.exr", 7), "shot.000007.exr");
}

TEST(Pattern, EachAtSignIsOneDigit) {
  EXPECT_EQ(path("shot.@.exr", 7), "shot.7.exr");
  EXPECT_EQ(path("shot.@@@.exr", 7), "shot.007.exr");
  EXPECT_EQ(path("shot.#@.exr", 7), "shot.00007.exr");
}

TEST(Pattern, PrintfStyleIsReadAsPrintfDoes) {
  EXPECT_EQ(path("shot.%04d.exr", 12), "shot.0012.exr");
  EXPECT_EQ(path("shot.%d.exr", 12), "shot.12.exr");
  EXPECT_EQ(path("shot.%04d.exr", -5), "shot.-005.exr");
}

TEST(Pattern, NumbersWiderThanThePaddingAreWrittenInFull) {
  EXPECT_EQ(path("shot.####.exr", 123456), "shot.123456.exr");
  EXPECT_EQ(path("shot.@@.exr", -123), "shot.-123.exr");
}

TEST(Pattern, RangeBeforeTheMarksIsARange) {
  const Pattern pattern = Pattern::parse("a/shot.1-3,10#.exr");
  EXPECT_EQ(pattern.inline_range(), (Frames{1, 2, 3, 10}));
  EXPECT_EQ(pattern.path(2), "a/shot.0002.exr");
  EXPECT_EQ(Pattern::parse("shot.1-10x3@@@.exr").inline_range(), (Frames{1, 4, 7, 10}));
  EXPECT_EQ(Pattern::parse("shot.-2--1#.exr").inline_range(), (Frames{-2, -1}));
  EXPECT_EQ(Pattern::parse("shot-1-2#.exr").inline_range(), (Frames{1, 2}));
  EXPECT_EQ(Pattern::parse("shot-1-2#.exr").path(1), "shot-0001.exr");
}

TEST(Pattern, PlainNumbersBeforeTheMarksBelongToTheName) {
  for (const char* text : {"v2#.exr", "shot_1920x1080#.exr", "shot.#.exr", "shot-5#.exr", "box-#.exr", "x#.exr"}) {
    EXPECT_FALSE(Pattern::parse(text).inline_range()) << text;
  }
  EXPECT_EQ(path("v2#.exr", 1), "v20001.exr");
}

TEST(Pattern, MarksInFolderNamesAreOrdinary) {
  const Pattern pattern = Pattern::parse("take#2/50%/shot.exr");
  EXPECT_TRUE(pattern.is_single());
  EXPECT_EQ(pattern.path(9), "take#2/50%/shot.exr");
  EXPECT_EQ(path("@/shot.##.exr", 9), "@/shot.09.exr");
}

TEST(Pattern, FolderIsWhatPrecedesTheName) {
  EXPECT_EQ(Pattern::parse("shot.exr").folder(), ".");
  EXPECT_EQ(Pattern::parse("/shot.exr").folder(), "/");
  EXPECT_EQ(Pattern::parse("a/b/shot.exr").folder(), "a/b");
}

TEST(Pattern, SingleFileTakesItsFrameFromTheLastDigits) {
  EXPECT_EQ(Pattern::parse("a.0012.exr").single_frame(), 12);
  EXPECT_EQ(Pattern::parse("pinhole_0001.exr").single_frame(), 1);
  EXPECT_EQ(Pattern::parse("v2/shot3b.exr").single_frame(), 3);
  EXPECT_EQ(Pattern::parse("v2/still.exr").single_frame(), 1);
  EXPECT_EQ(Pattern::parse("still7").single_frame(), 7);
  EXPECT_EQ(Pattern::parse("99999999999.exr").single_frame(), 1);
}

TEST(Pattern, MalformedPatternsAreUsageErrors) {
  for (const char* text : {"", "folder/", "a.#.b.#.exr", "a.#.%04d.exr", "a.%d.%d.exr", "a.%4d.exr", "a.%s.exr",
                           "a.%0xd.exr", "a%.exr", "a.%0999d.exr", "a.1-3x0#.exr"}) {
    SCOPED_TRACE(text);
    test::expect_error(ErrorCode::usage, {}, [&] { Pattern::parse(text); });
  }
}

TEST(Pattern, DiscoverTakesOnlyNamesThatPathWouldWrite) {
  test::TempFolder folder;
  for (const char* name : {"shot.0002.exr", "shot.0010.exr", "shot.12345.exr", "shot.-001.exr", "shot.7.exr",
                           "shot.00011.exr", "shot.0003.exr.bak", "shot.0003.png", "other.0004.exr", "shot.00a5.exr",
                           "shot..exr", "shot.0006.1a2b3c4d.temp.exr", "shot.+004.exr"}) {
    test::write_bytes(folder / name, "x");
  }
  EXPECT_EQ(Pattern::parse(folder / "shot.####.exr").discover(), (Frames{-1, 2, 10, 12345}));
  EXPECT_EQ(Pattern::parse(folder / "shot.%d.exr").discover(), (Frames{7, 12345}));
  EXPECT_EQ(Pattern::parse(folder / "none.####.exr").discover(), Frames{});
}

TEST(Pattern, DiscoverOfASingleFileIsItsFrame) {
  test::TempFolder folder;
  test::write_bytes(folder / "still.0042.exr", "x");
  EXPECT_EQ(Pattern::parse(folder / "still.0042.exr").discover(), Frames{42});
}

TEST(Pattern, DiscoverSaysWhatIsMissing) {
  test::TempFolder folder;
  const auto discover = [&](const std::string& text) { return [text] { Pattern::parse(text).discover(); }; };
  test::expect_error(ErrorCode::unreadable, {"no such file"}, discover(folder / "still.exr"));
  test::expect_error(ErrorCode::unreadable, {"is a folder", "####"}, discover(folder.path()));
  test::expect_error(ErrorCode::unreadable, {folder / "nowhere"}, discover(folder / "nowhere/a.####.exr"));
}

TEST(OutputNames, FolderTakesTheInputsNames) {
  test::TempFolder folder;
  const Pattern input = Pattern::parse("in/shot.1-3#.exr");
  EXPECT_EQ(OutputNames(folder.path(), input, {1, 2}).path(2), folder / "shot.0002.exr");
  EXPECT_EQ(OutputNames("new/", input, {1, 2}).path(2), "new/shot.0002.exr");
  EXPECT_EQ(OutputNames("new/", Pattern::parse("in/still.exr"), {1}).path(1), "new/still.exr");
}

TEST(OutputNames, PatternIsUsedAsItIs) {
  EXPECT_EQ(OutputNames("out/b.%d.exr", Pattern::parse("a.####.exr"), {1, 2}).path(2), "out/b.2.exr");
  EXPECT_EQ(OutputNames("out/b.exr", Pattern::parse("a.####.exr"), {5}).path(5), "out/b.exr");
}

TEST(OutputNames, SeveralFramesDoNotGoIntoOneFile) {
  test::expect_error(ErrorCode::usage, {"out.exr", "2 frames"}, [] {
    OutputNames("out.exr", Pattern::parse("a.####.exr"), {1, 2});
  });
  test::expect_error(ErrorCode::usage, {"--frames"}, [] {
    OutputNames("out.1-9#.exr", Pattern::parse("a.####.exr"), {1, 2});
  });
}

TEST(OutputNames, InputIsNotReplacedByItsOutput) {
  test::TempFolder folder;
  test::write_bytes(folder / "a.0001.exr", "x");
  std::filesystem::create_symlink(folder.path(), folder / "link");
  const Pattern input = Pattern::parse(folder / "a.####.exr");
  for (const char* output : {"", "link", "a.%04d.exr", "link/a.#.exr"}) {
    SCOPED_TRACE(output);
    test::expect_error(ErrorCode::usage, {"own input"}, [&] { OutputNames(folder / output, input, {1}); });
  }
}

TEST(OutputNames, MissingFolderIsNamedAndNotCreated) {
  test::TempFolder folder;
  test::write_bytes(folder / "file", "x");
  const Pattern input = Pattern::parse("a.####.exr");
  test::expect_error(ErrorCode::unwritable, {folder / "new", "no such folder"},
                     [&] { OutputNames(folder / "new/", input, {1}).require_folder(); });
  test::expect_error(ErrorCode::unwritable, {folder / "file", "not a folder"},
                     [&] { OutputNames(folder / "file/b.#.exr", input, {1}).require_folder(); });
  EXPECT_NO_THROW(OutputNames(folder.path(), input, {1}).require_folder());
  EXPECT_EQ(folder.files(), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace pullfocus::exr
