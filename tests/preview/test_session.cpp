// A session: views, playing, export, and what it says of itself.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "image/error.h"
#include "live_shot.h"

namespace pullfocus::cli::preview {
namespace {

using test::LiveShot;
using test::settle;

class SessionTest : public testing::Test {
 protected:
  void does(const std::string& line) { session.perform(parse_action(line)); }

  LiveShot files{4};
  LiveSession session{files.arguments()};
};

TEST_F(SessionTest, ShowsTheFirstFrameExactlyWithoutBeingAsked) {
  settle(session);
  const Snapshot now = session.snapshot();
  EXPECT_TRUE(now.shown->exact);
  EXPECT_EQ(now.frames, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(now.frame, 0u);
  EXPECT_EQ(now.width, 24);
  EXPECT_EQ(now.height, 18);
  EXPECT_FALSE(now.loading);
  EXPECT_GT(now.memory_bytes, 0u);
  for (int i = 0; i < 10000 && session.snapshot().loaded != std::vector<bool>(4, true); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(session.snapshot().loaded, std::vector<bool>(4, true)) << "the others follow";
}

TEST_F(SessionTest, GoesToFramesByNumberAndByStep) {
  does("frame 3");
  EXPECT_EQ(session.snapshot().frame, 2u);
  does("step -1");
  EXPECT_EQ(session.snapshot().frame, 1u);
  does("step 100");
  EXPECT_EQ(session.snapshot().frame, 3u);
  does("step -100");
  EXPECT_EQ(session.snapshot().frame, 0u);
  try {
    does("frame 9");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "frame 9 is not part of the shot, which has 4 frames from 1 to 4");
  }
}

TEST_F(SessionTest, PlaysInTimeShowingEachFrameItGoesToAndCountsTheOthers) {
  settle(session);
  does("fps 10");
  does("loop off");
  does("play");
  double time = 100;
  session.tick(time);
  EXPECT_EQ(session.snapshot().frame, 0u);
  const auto shown = [&] {
    while (session.snapshot().shown->request != session.snapshot().request) std::this_thread::yield();
  };
  shown();
  session.tick(time + 0.09);
  EXPECT_EQ(session.snapshot().frame, 0u) << "not yet";
  session.tick(time + 0.11);
  EXPECT_EQ(session.snapshot().frame, 1u);
  shown();
  session.tick(time + 0.31);
  EXPECT_EQ(session.snapshot().frame, 3u);
  EXPECT_EQ(session.snapshot().dropped, 1) << "frame 3's time had passed";
  shown();
  session.tick(time + 0.5);
  EXPECT_FALSE(session.snapshot().playing) << "at the end";
  settle(session);
  EXPECT_TRUE(session.snapshot().shown->exact);
}

TEST_F(SessionTest, PlayingInALoopBeginsAgain) {
  settle(session);
  does("fps 10");
  does("frame 4");
  does("play");
  EXPECT_EQ(session.snapshot().frame, 0u) << "from the end, at the beginning";
  double time = 5;
  for (int i = 0; i < 9; ++i, time += 0.1) {
    while (session.snapshot().shown->request != session.snapshot().request) std::this_thread::yield();
    session.tick(time);
  }
  EXPECT_TRUE(session.snapshot().playing);
  EXPECT_LT(session.snapshot().frame, 4u);
  does("pause");
  settle(session);
}

TEST_F(SessionTest, TellsWhatLiesUnderThePointer) {
  settle(session);
  const Probe wall = session.probe(1, 1), square = session.probe(5, 8);
  EXPECT_TRUE(wall.inside);
  EXPECT_FLOAT_EQ(wall.depth, 3.2f);
  EXPECT_TRUE(wall.has_coc);
  EXPECT_GT(wall.coc, 0);
  EXPECT_EQ(square.depth, 2);
  EXPECT_EQ(square.coc, 0);
  EXPECT_EQ(square.colour[0], 4);
  EXPECT_FALSE(session.probe(-1, 3).inside);
  EXPECT_FALSE(session.probe(24, 3).inside);
}

TEST_F(SessionTest, WritesTheExactFrameWhateverIsShown) {
  settle(session);
  does("refine off");
  does("budget 1");
  does("frame 2");
  does("focus 2.7");
  does("view depth");
  does("export " + (files.folder / "out.####.exr"));
  does("export " + (files.folder / "out.png"));
  does("frame 3");
  settle(session);
  EXPECT_EQ(session.failures(), 0);
  ASSERT_EQ(pullfocus::test::run("filter " + files.pattern() + " -o " + (files.folder / "ref.exr") +
                                 " --frames 2 --focus 2.7")
                .code,
            0);
  EXPECT_EQ(exr::test::file_bytes(files.folder / "out.0002.exr"), exr::test::file_bytes(files.folder / "ref.exr"));
  EXPECT_TRUE(std::filesystem::exists(files.folder / "out.png"));
  pullfocus::test::expect_no_temporaries(files.folder);
}

TEST_F(SessionTest, SaysWhatItCouldNotWrite) {
  settle(session);
  EXPECT_THROW(does("export " + (files.folder / "missing/out.exr")), Error);
  EXPECT_THROW(does("export " + files.pattern()), Error) << "an input is never replaced";
  does("export " + (files.folder / "missing/out.png"));
  settle(session);
  EXPECT_EQ(session.failures(), 1);
  EXPECT_TRUE(session.snapshot().message_is_error);
  EXPECT_NE(session.snapshot().message.find("missing/out.png"), std::string::npos);
}

// Asked without a pause: an export goes from the thread that filters to the one that writes, and must be seen with one
// of them at every moment.
TEST_F(SessionTest, IsWritingUntilAnExportIsWrittenOrHasFailed) {
  settle(session);
  const int before = session.failures();
  for (int i = 1; i <= 2000; ++i) {
    does("export " + (files.folder / "missing/out.png"));
    while (session.is_writing()) {
    }
    ASSERT_EQ(session.failures(), before + i);
  }
}

TEST_F(SessionTest, RefusesNonsenseNamingIt) {
  for (const char* line : {"view sideways", "budget much", "refine perhaps", "exposure bright", "wipe 2", "fps 0",
                           "kernel square", "visibility clear", "step far", "loop 1", "export", "export-shot"}) {
    EXPECT_THROW(does(line), Error) << line;
  }
  EXPECT_EQ(session.snapshot().kernel, "disc");
  session.act(parse_action("kernel square"));
  EXPECT_TRUE(session.snapshot().message_is_error);
  settle(session);
  EXPECT_TRUE(session.snapshot().shown->exact);
}

TEST_F(SessionTest, ClosesInTheMiddleOfAnything) {
  for (int i = 0; i < 20; ++i) {
    LiveSession other(files.arguments());
    other.perform(parse_action("play"));
    if (i % 2 == 0) other.perform(parse_action("export " + (files.folder / ("closing." + std::to_string(i) + ".exr"))));
    if (i % 3 == 0) other.tick(i);
  }
  for (int i = 0; i < 20; i += 2) {
    EXPECT_TRUE(std::filesystem::exists(files.folder / ("closing." + std::to_string(i) + ".exr"))) << "nothing is lost";
  }
}

TEST(SessionOfALiveFolder, TakesInFramesThatAppearOrAreWrittenAgainAndKeepsTheRest) {
  const LiveShot files(2);
  PreviewArguments arguments = files.arguments();
  arguments.live = true;
  LiveSession session(arguments);
  session.perform(parse_action("frame 2"));
  session.perform(parse_action("key focus 2 2.5"));
  settle(session);
  double time = 1e7;  // later than settle() says
  const auto lives_until = [&](auto&& done) {
    for (int i = 0; i < 5000 && !done(); ++i) {
      session.tick(time += 2);  // time flies
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ASSERT_TRUE(done());
    settle(session);
  };
  const std::uint64_t before = session.snapshot().request;
  for (int i = 0; i < 20; ++i) session.tick(1e6 + 2 * i);
  EXPECT_EQ(session.snapshot().request, before) << "nothing new";

  pullfocus::test::write_shot(files.folder, 3, 5);
  lives_until([&] { return session.snapshot().frames.size() == 5; });
  EXPECT_EQ(session.snapshot().frames[session.snapshot().frame], 2) << "the frame stays";
  EXPECT_EQ(session.snapshot().focus.value, 2.5);
  EXPECT_NE(session.snapshot().message.find("3-5"), std::string::npos) << session.snapshot().message;
  session.perform(parse_action("frame 5"));
  settle(session);
  EXPECT_TRUE(session.snapshot().shown->exact);

  pullfocus::test::write_shot(files.folder, 5, 5);
  const auto written = std::filesystem::last_write_time(files.folder / "shot.0005.exr");
  std::filesystem::last_write_time(files.folder / "shot.0005.exr", written + std::chrono::seconds(7));
  lives_until([&] { return session.snapshot().message.find("read again") != std::string::npos; });
  EXPECT_TRUE(session.snapshot().shown->exact);

  session.perform(parse_action("live off"));
  std::filesystem::remove(files.folder / "shot.0001.exr");
  for (int i = 0; i < 100; ++i) session.tick(time += 2);
  EXPECT_EQ(session.snapshot().frames.size(), 5u);
}

TEST(SessionOfABadShot, OpensWithAFrameThatCannotBeRead) {
  const LiveShot files(3);
  std::ofstream(files.folder / "shot.0002.exr") << "no picture";
  LiveSession session(files.arguments());
  EXPECT_TRUE(session.snapshot().message_is_error);
  EXPECT_NE(session.snapshot().message.find("shot.0002.exr"), std::string::npos) << session.snapshot().message;
  session.perform(parse_action("frame 2"));
  settle(session);
  EXPECT_NE(session.snapshot().shown->problem.find("shot.0002.exr"), std::string::npos);
  session.perform(parse_action("frame 3"));
  settle(session);
  EXPECT_EQ(session.snapshot().shown->problem, "");
  EXPECT_TRUE(session.snapshot().shown->exact);
}

TEST(SessionOfABadShot, IsRefusedIfThereIsNoFrameAtAll) {
  PreviewArguments arguments;
  arguments.input.input = "/nowhere/shot.####.exr";
  EXPECT_THROW(LiveSession{arguments}, Error);
}

TEST(SessionWithoutACamera, ShowsTheInputUntilAllIsSet) {
  const LiveShot files(1);
  PreviewArguments arguments = files.arguments();
  arguments.input.input = files.folder / "bare.exr";
  exr::test::TestImage image({0, 0, 16, 16}, {0, 0, 16, 16});
  for (const char* name : {"R", "G", "B"}) image.add_constant(name, Imf::HALF, 0.5f);
  image.add_constant("Z", Imf::FLOAT, 3);
  exr::test::write_scanlines(arguments.input.input, image);
  LiveSession session(arguments);
  settle(session);
  EXPECT_NE(session.snapshot().shown->problem.find("--fstop"), std::string::npos) << session.snapshot().shown->problem;
  EXPECT_NE(session.snapshot().shown->picture, nullptr);
  EXPECT_FALSE(session.snapshot().focus.value.has_value());
  EXPECT_FALSE(session.probe(3, 3).has_coc);
  for (const char* line : {"focus-at 3,3", "fstop 2", "focal-length 50"}) session.perform(parse_action(line));
  settle(session);
  EXPECT_EQ(session.snapshot().shown->problem, "");
  EXPECT_TRUE(session.snapshot().shown->exact);
  EXPECT_EQ(session.probe(3, 3).coc, 0);
}

}  // namespace
}  // namespace pullfocus::cli::preview
