// `pullfocus preview --headless`: scripts through the real program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "live_shot.h"

namespace pullfocus::cli::preview {
namespace {

using pullfocus::test::Outcome;
using test::LiveShot;

class Headless : public testing::Test {
 protected:
  Outcome runs(const std::string& script, const std::string& options = "") {
    std::ofstream(files.folder / "script.txt") << script;
    return pullfocus::test::run("preview '" + files.pattern() + "' --threads 2 --keys '" +
                                (files.folder / "keys.toml") + "' --headless '" + (files.folder / "script.txt") + "' " +
                                options);
  }
  std::string file(const std::string& name) const { return files.folder / name; }

  LiveShot files{6};
};

std::vector<nlohmann::json> lines(const std::string& text) {
  std::vector<nlohmann::json> found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) found.push_back(nlohmann::json::parse(line));
  return found;
}

TEST_F(Headless, ExportsBitForBitWhatFilterWritesAfterKeysDragsAndPlaying) {
  const Outcome outcome = runs(
      "wait\nfocus-at 5,8\nkey focus\nframe 6\nfocus-at 22,1\nhold\nfstop 1.4\nfstop 1.2\nrelease\n"
      "kernel polygon:5\nloop off\nframe 1\nplay\nwait\n"
      "frame 3\nexport " +
      file("three.exr") + "\nframe 5\nwait\nexport " + file("five.exr") + "\nsave-keys\nexport-shot " + file("all/") +
      "\nwait\nstatus\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto status = lines(outcome.out).back();
  EXPECT_TRUE(status["exact"]);
  EXPECT_EQ(status["pending"], 0);
  EXPECT_FALSE(status["unsaved"]);
  const std::string camera = "--focus @" + file("keys.toml") + " --fstop @" + file("keys.toml") + " --kernel polygon:5";
  ASSERT_EQ(pullfocus::test::run("filter '" + files.pattern() + "' -o " + file("ref/") + " --mkdir " + camera).code, 0);
  EXPECT_EQ(exr::test::file_bytes(file("three.exr")), exr::test::file_bytes(file("ref/shot.0003.exr")));
  EXPECT_EQ(exr::test::file_bytes(file("five.exr")), exr::test::file_bytes(file("ref/shot.0005.exr")));
  for (int frame = 1; frame <= 6; ++frame) {
    const std::string name = fmt::format("shot.{:04d}.exr", frame);
    EXPECT_EQ(exr::test::file_bytes(file("all/" + name)), exr::test::file_bytes(file("ref/" + name))) << name;
  }
}

TEST_F(Headless, GivesACommandThatMakesTheSameShot) {
  const Outcome outcome =
      runs("key focus 1 2\nkey focus 6 inf\nfstop 1.3\nvisibility none\nwait\nexport " + file("four.exr") +
               "\nwait\nframe 4\nexport " + file("four.exr") + "\nwait\nstatus\n",
           "--max-coc 50 -o " + file("made/"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::string command = lines(outcome.out).back()["command"];
  ASSERT_TRUE(command.starts_with("pullfocus "));
  ASSERT_EQ(pullfocus::test::run(command.substr(10) + " --mkdir").code, 0) << command;
  EXPECT_EQ(exr::test::file_bytes(file("four.exr")), exr::test::file_bytes(file("made/shot.0004.exr")));
}

TEST_F(Headless, ShowsEveryViewAsAPicture) {
  std::string script = "frame 2\nwait\nwipe 0.5\n";
  for (const char* view : kViewNames) script += std::string("view ") + view + "\nwait\nshow " + file(view) + ".png\n";
  const Outcome outcome = runs(script);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* view : kViewNames) EXPECT_TRUE(std::filesystem::exists(file(view) + ".png")) << view;
  EXPECT_NE(exr::test::file_bytes(file("depth.png")), exr::test::file_bytes(file("coc.png")));
}

TEST_F(Headless, DoesARecordingAgain) {
  const Outcome first =
      runs("frame 2\nfocus 2.5\nkey focus 2\nkey focus 5 3\nundo\nwait\nstatus\n", "--record " + file("rec.txt"));
  ASSERT_EQ(first.code, 0) << first.err;
  const Outcome second = runs(exr::test::file_bytes(file("rec.txt")) + "wait\nstatus\n");
  ASSERT_EQ(second.code, 0) << second.err;
  auto a = lines(first.out).back(), b = lines(second.out).back();
  for (auto* status : {&a, &b}) {
    status->erase("ms");
    status->erase("calls");
  }
  EXPECT_EQ(a, b);
}

TEST_F(Headless, NamesTheLineThatIsWrong) {
  for (const char* wrong : {"fly", "focus", "view \"x", "focus nowhere", "show", "frame 77"}) {
    const Outcome outcome = runs(std::string("wait\n# comment\n") + wrong + "\n");
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_NE(outcome.err.find("script.txt:3: "), std::string::npos) << outcome.err;
  }
  const Outcome outcome = pullfocus::test::run("preview '" + files.pattern() + "' --headless /nowhere/script");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
}

TEST_F(Headless, EndsWithAFailureIfAFrameCannotBeReadOrWritten) {
  std::ofstream(file("shot.0003.exr")) << "no picture";
  EXPECT_EQ(runs("frame 2\nwait\n").code, 0) << "others are of no consequence";
  const Outcome bad = runs("frame 3\nwait\nframe 4\nwait\nstatus\n");
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.err.find("shot.0003.exr"), std::string::npos) << bad.err;
  EXPECT_TRUE(lines(bad.out).back()["exact"]);
  EXPECT_EQ(runs("wait\nexport " + file("no/such.png") + "\nwait\n").code, 1);
}

TEST_F(Headless, WarnsOfKeysThatWereNotSaved) {
  EXPECT_NE(runs("focus 3\nwait\n").err.find("not saved"), std::string::npos);
  EXPECT_EQ(runs("focus 3\nwait\nsave-keys\n").err.find("not saved"), std::string::npos);
}

TEST_F(Headless, StopsWritingAShotWhenAskedTo) {
  const Outcome outcome = runs("wait\nexport-shot " + file("cut/") + "\ncancel\nwait\nstatus\n");
  EXPECT_TRUE(outcome.code == 0 || outcome.code == 1) << outcome.err;  // it may have been done already
  if (outcome.code == 1) {
    EXPECT_NE(outcome.err.find("not complete"), std::string::npos) << outcome.err;
  }
}

TEST(PreviewWithoutADisplay, SaysSoInOneLine) {
  const LiveShot files(1);
  const Outcome outcome = pullfocus::test::run_program(
      "env", "-u DISPLAY -u WAYLAND_DISPLAY '" PULLFOCUS_PROGRAM "' preview '" + files.pattern() + "'");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("no display"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--headless"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pullfocus::cli::preview
