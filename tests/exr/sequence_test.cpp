#include "exr/sequence.h"

#include "exr/exr_files.h"
#include "exr/state_window.h"

namespace pullfocus::exr {
namespace {

using test::expect_error;
using test::TempFolder;
using test::TestImage;

const Window display = {0, 0, 20, 10};

class SequenceTest : public testing::Test {
 protected:
  void write(int frame, const Window& data = display, const Window& its_display = display, float aspect = 1) {
    TestImage image(its_display, data);
    image.add_rgbaz();
    image.header.pixelAspectRatio() = aspect;
    test::write_scanlines(pattern_.path(frame), image);
  }
  Sequence open(const std::string& range = "", BadFrames bad_frames = BadFrames::fail) {
    return open_sequence(pattern_, range, bad_frames);
  }
  std::vector<int> frames(const Sequence& sequence) {
    std::vector<int> numbers;
    for (const SequenceFrame& frame : sequence.frames) numbers.push_back(frame.frame);
    return numbers;
  }

  TempFolder folder_;
  Pattern pattern_ = Pattern::parse(folder_ / "shot.####.exr");
};

TEST_F(SequenceTest, WithoutARangeEveryFileIsTakenAndGapsAreReported) {
  for (const int frame : {9, 1, 2, 5}) write(frame);
  const Sequence sequence = open();
  EXPECT_EQ(frames(sequence), (std::vector<int>{1, 2, 5, 9}));
  EXPECT_EQ(sequence.gaps, (std::vector<int>{3, 4, 6, 7, 8}));
  EXPECT_EQ(sequence.frames[2].path, pattern_.path(5));
  EXPECT_EQ(sequence.first.path, pattern_.path(1));
  EXPECT_EQ(sequence.display_window, display);
}

TEST_F(SequenceTest, RangeGivesTheOrderAndHasNoGaps) {
  for (const int frame : {1, 2, 3, 9}) write(frame);
  const Sequence sequence = open("9,2-1");
  EXPECT_EQ(frames(sequence), (std::vector<int>{9, 2, 1}));
  EXPECT_TRUE(sequence.gaps.empty());
  EXPECT_EQ(sequence.first.path, pattern_.path(9));
}

TEST_F(SequenceTest, RangeInThePatternIsUsedUnlessOneIsGiven) {
  for (const int frame : {1, 2, 3}) write(frame);
  pattern_ = Pattern::parse(folder_ / "shot.2-3#.exr");
  EXPECT_EQ(frames(open()), (std::vector<int>{2, 3}));
  EXPECT_EQ(frames(open("1")), std::vector<int>{1});
}

TEST_F(SequenceTest, UnionCountsFilesOutsideTheRange) {
  write(1, {5, 5, 8, 8});
  write(2, {-4, 2, 6, 9});
  write(3, {3, 3, 30, 6});
  EXPECT_EQ(open().data_union, (Window{-4, 2, 30, 9}));
  EXPECT_EQ(open("1").data_union, (Window{-4, 2, 30, 9}));
  EXPECT_EQ(open("1").frames[0].data_window, (Window{5, 5, 8, 8}));
}

TEST_F(SequenceTest, MissingRequestedFrameIsNamed) {
  write(1);
  expect_error(ErrorCode::unreadable, {"frame 3", pattern_.path(3), "no such file"}, [&] { open("1,3"); });
  const Sequence sequence = open("1,3", BadFrames::keep);
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.frames[0].problem, "");
  EXPECT_NE(sequence.frames[1].problem.find("frame 3"), std::string::npos);
}

TEST_F(SequenceTest, NoFileAtAllIsAnError) {
  expect_error(ErrorCode::unreadable, {"no file matches", pattern_.text()}, [&] { open(); });
  expect_error(ErrorCode::unreadable, {"frame 4", pattern_.path(4)}, [&] { open("4-5"); });
  expect_error(ErrorCode::unreadable, {"frame 4"}, [&] { open("4-5", BadFrames::keep); });
  expect_error(ErrorCode::usage, {"'4-'"}, [&] { open("4-"); });
}

TEST_F(SequenceTest, UnreadableHeaderFailsOrIsKept) {
  write(1);
  write(3, {-5, 0, 5, 5});
  test::write_bytes(pattern_.path(2), "no image");
  expect_error(ErrorCode::unreadable, {"frame 2", pattern_.path(2)}, [&] { open(); });
  const Sequence kept = open("", BadFrames::keep);
  EXPECT_NE(kept.frames[1].problem, "");
  EXPECT_EQ(kept.data_union, unite(display, {-5, 0, 5, 5}));
  EXPECT_NO_THROW(open("1,3"));
}

TEST_F(SequenceTest, OtherGeometryNamesTheFirstFrameThatDiffers) {
  for (const int frame : {1, 2, 5}) write(frame);
  write(3, display, {0, 0, 21, 10});
  write(4, display, display, 2);
  expect_error(ErrorCode::unreadable, {"frame 3", "21x10", "20x10", "of frame 1"}, [&] { open(); });
  expect_error(ErrorCode::unreadable, {"frame 3"}, [&] { open("1-2"); });
  const Sequence kept = open("", BadFrames::keep);
  EXPECT_EQ(kept.frames[1].problem, "");
  EXPECT_NE(kept.frames[2].problem.find("21x10"), std::string::npos);
  EXPECT_NE(kept.frames[3].problem.find("aspect 2"), std::string::npos);
}

TEST_F(SequenceTest, SingleFileIsASequenceOfOne) {
  write(7);
  pattern_ = Pattern::parse(folder_ / "shot.0007.exr");
  EXPECT_EQ(frames(open()), std::vector<int>{7});
  EXPECT_EQ(frames(open("7")), std::vector<int>{7});
  expect_error(ErrorCode::unreadable, {"frame 1", "it is frame 7"}, [&] { open("1"); });
}

TEST_F(SequenceTest, HundredsOfFilesAreScanned) {
  for (int frame = 1; frame <= 300; ++frame) write(frame, {-frame, 0, 3, 1});
  EXPECT_EQ(open("1-300x100").data_union, (Window{-300, 0, 3, 1}));
}

TEST_F(SequenceTest, FarApartFramesReportAMillionGapsAtMost) {
  write(0);
  write(2000000000);
  EXPECT_EQ(open().gaps.size(), 1000000u);
}

TEST(StateWindow, AutomaticHoldsDisplayAndData) {
  EXPECT_EQ(state_window(display, {5, -3, 8, 4}, {}), (Window{0, -3, 20, 10}));
  EXPECT_EQ(state_window(display, {}, {}), display);
}

TEST(StateWindow, MarginsGrowTheDisplayWindowAlone) {
  EXPECT_EQ(state_window(display, {-100, 0, 100, 1}, parse_overscan("1,2,3,4")), (Window{-1, -2, 23, 14}));
  EXPECT_EQ(state_window(display, {-100, 0, 100, 1}, parse_overscan("0,0,0,0")), display);
}

TEST(StateWindow, AutoIsTheDefault) { EXPECT_EQ(parse_overscan("auto"), Overscan{}); }

TEST(StateWindow, NonsenseIsAUsageError) {
  for (const char* text : {"", "Auto", "1", "1,2,3", "1,2,3,4,5", "1,2,3,-4", "1,2,3,4 ", "1.5,2,3,4", "1,,3,4",
                           ",1,2,3", "99999999999,0,0,0", "2000000,0,0,0", "a,b,c,d"}) {
    SCOPED_TRACE(text);
    expect_error(ErrorCode::usage, {"--overscan"}, [&] { parse_overscan(text); });
  }
}

TEST(StateWindow, AbsurdWindowIsRefused) {
  expect_error(ErrorCode::usage, {"--overscan"}, [] { state_window(display, {0, 0, 1 << 20, 1 << 20}, {}); });
  expect_error(ErrorCode::usage, {"--overscan"}, [] {
    state_window(display, {-1000000000, -1000000000, -999999999, 1}, {});
  });
}

}  // namespace
}  // namespace pullfocus::exr
