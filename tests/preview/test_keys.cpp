// Settings of the camera in a session: values, keys, undo, files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "image/error.h"
#include "live_shot.h"

namespace pullfocus::cli::preview {
namespace {

using test::LiveShot;
using test::settle;

class KeysOfASession : public testing::Test {
 protected:
  void does(const std::string& line) { session.perform(parse_action(line)); }
  std::string message_of(const std::string& line) {
    try {
      does(line);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::vector<Key> focus_keys() { return session.snapshot().keys.focus->keys(); }
  double focus() { return session.snapshot().focus.value.value_or(-1); }

  LiveShot files{4};
  LiveSession session{files.arguments()};
};

TEST_F(KeysOfASession, ComeFromTheHeaderUntilSomethingIsSet) {
  Snapshot now = session.snapshot();
  EXPECT_EQ(now.focus.source, "header");
  EXPECT_EQ(now.focus.value, 2);
  EXPECT_EQ(now.focal_length.value, 50);
  EXPECT_FALSE(now.unsaved);
  does("focus 3.5");
  now = session.snapshot();
  EXPECT_EQ(now.focus.source, "set");
  EXPECT_EQ(now.focus.value, 3.5);
  EXPECT_EQ(now.fstop.source, "header");
  EXPECT_TRUE(now.unsaved);
}

TEST_F(KeysOfASession, WithoutKeysAValueHoldsForAllFramesAndWithKeysItBecomesAKeyHere) {
  does("focus 3");
  does("frame 4");
  EXPECT_EQ(focus(), 3);
  does("key focus");
  does("frame 1");
  EXPECT_EQ(focus(), 3);
  does("focus 2");
  EXPECT_EQ(focus_keys(), (std::vector<Key>{{1, 2}, {4, 3}}));
  does("frame 2");
  EXPECT_NEAR(focus(), 1 / (2. / 3 * 1 / 2 + 1. / 3 * 1 / 3), 1e-12);  // dioptres
  does("interp distance");
  EXPECT_NEAR(focus(), 2 + 1. / 3, 1e-12);
  does("focus 9");
  EXPECT_EQ(focus_keys().size(), 3u);
  does("focus 8");
  EXPECT_EQ(focus_keys(), (std::vector<Key>{{1, 2}, {2, 8}, {4, 3}})) << "a key here is replaced";
}

TEST_F(KeysOfASession, MoveAndGo) {
  does("key focus 1 2");
  does("key focus 3 inf");
  does("move-key focus 3 4");
  EXPECT_EQ(focus_keys(), (std::vector<Key>{{1, 2}, {4, INFINITY}}));
  does("move-key focus 1 4");
  EXPECT_EQ(focus_keys(), (std::vector<Key>{{4, 2}})) << "the one that is moved stays";
  does("unkey focus 4");
  EXPECT_TRUE(session.snapshot().keys.focus->is_constant());
  EXPECT_EQ(focus(), 2);
  does("key fstop 1 2");
  does("key fstop 4 8");
  does("frame 2");
  EXPECT_EQ(session.snapshot().fstop.value, 4);
  does("unkey fstop all");
  EXPECT_EQ(session.snapshot().fstop.value, 4) << "as it is here";
}

TEST_F(KeysOfASession, AreTakenBackAndMadeAgainStepByStepAndADragIsOneStep) {
  const CameraKeys begin = session.snapshot().keys;
  does("focus 3");
  does("hold");
  for (int i = 0; i < 10; ++i) does("fstop " + std::to_string(2 + i));
  does("release");
  does("kernel polygon:6");
  const CameraKeys end = session.snapshot().keys;
  does("undo");
  EXPECT_EQ(session.snapshot().kernel, "disc");
  does("undo");
  EXPECT_EQ(session.snapshot().fstop.source, "header");
  EXPECT_EQ(focus(), 3);
  does("undo");
  EXPECT_EQ(session.snapshot().keys, begin);
  EXPECT_FALSE(session.snapshot().can_undo);
  does("undo");  // says that there is nothing
  for (int i = 0; i < 3; ++i) does("redo");
  EXPECT_EQ(session.snapshot().keys, end);
  EXPECT_EQ(session.snapshot().kernel, "polygon:6");
  EXPECT_FALSE(session.snapshot().can_redo);
  does("undo");
  does("focus 7");
  EXPECT_FALSE(session.snapshot().can_redo) << "another change ends what could be made again";
}

TEST_F(KeysOfASession, GoThroughTheFileThatFilterReads) {
  does("key focus 1 2");
  does("key focus 4 inf");
  does("interp smooth");
  does("fstop 1.7");
  does("save-keys");
  EXPECT_FALSE(session.snapshot().unsaved);
  EXPECT_EQ(load_camera_keys(files.folder / "keys.toml"), session.snapshot().keys);
  const CameraKeys saved = session.snapshot().keys;
  does("focus 5");
  EXPECT_TRUE(session.snapshot().unsaved);
  does("load-keys " + (files.folder / "keys.toml"));
  EXPECT_EQ(session.snapshot().keys, saved);
  EXPECT_FALSE(session.snapshot().unsaved);
}

TEST_F(KeysOfASession, ThatCannotBeSavedAreNotLost) {
  does("focus 5");
  EXPECT_NE(message_of("save-keys " + (files.folder / "no/such/folder.toml")), "");
  EXPECT_TRUE(session.snapshot().unsaved);
  EXPECT_EQ(focus(), 5);
}

TEST_F(KeysOfASession, RefuseNonsenseNamingItAndChangeNothing) {
  does("key focus 2 3");
  const CameraKeys before = session.snapshot().keys;
  for (const char* line : {"focus far", "focus -1", "fstop inf", "key zoom", "key focus x", "key focus 1 1:2,3:4",
                           "unkey fstop", "unkey focus 3", "move-key focus 1 3", "move-key fstop 1 2", "interp cubic",
                           "load-keys nowhere.toml", "key", "focus", "nonsense"}) {
    EXPECT_NE(message_of(line), "") << line;
    EXPECT_EQ(session.snapshot().keys, before) << line;
  }
}

TEST_F(KeysOfASession, ByAClickAreTheDepthOfThatPixel) {
  EXPECT_NE(message_of("focus-at 100,3").find("100,3"), std::string::npos);
  EXPECT_NE(message_of("focus-at 5"), "");
  settle(session);
  does("focus-at 1,1");
  EXPECT_NEAR(focus(), 3.2, 1e-6);  // of the slanted wall
  does("focus-at 5,8");
  EXPECT_EQ(focus(), 2);  // of the square
}

TEST(KeysThatAreNotSaved, AreKeptAsideUntilTheSessionEndsAsItShould) {
  const LiveShot files(2);
  PreviewArguments arguments = files.arguments();
  arguments.autosave = true;
  const std::string aside = LiveSession::autosave_file(arguments.keys);
  {
    LiveSession session(arguments);
    session.tick(100);
    EXPECT_FALSE(std::filesystem::exists(aside)) << "nothing was changed";
    session.perform(parse_action("key focus 1 3"));
    session.tick(101);
    EXPECT_EQ(load_camera_keys(aside), session.snapshot().keys);
    session.perform(parse_action("key focus 2 4"));
    session.tick(101.5);
    EXPECT_NE(load_camera_keys(aside), session.snapshot().keys) << "once a second";
    session.tick(102.5);
    EXPECT_EQ(load_camera_keys(aside), session.snapshot().keys);
    LiveSession other(arguments);  // as after a crash
    EXPECT_NE(other.snapshot().message.find(aside), std::string::npos) << other.snapshot().message;
    session.perform(parse_action("save-keys"));
    EXPECT_FALSE(std::filesystem::exists(aside));
    session.perform(parse_action("focus 5"));
    session.tick(104);
    EXPECT_TRUE(std::filesystem::exists(aside));
  }
  EXPECT_FALSE(std::filesystem::exists(aside)) << "who closes the session has been asked";
}

TEST(KeysWithoutALens, AreRefused) {
  const LiveShot files(1);
  PreviewArguments arguments = files.arguments();
  arguments.camera.depth_kind = "coc";
  LiveSession session(arguments);
  EXPECT_FALSE(session.snapshot().has_lens);
  for (const char* line : {"focus 2", "focus-at 1,1", "key focus 1 2"}) {
    EXPECT_THROW(session.perform(parse_action(line)), Error) << line;
  }
  settle(session);
  EXPECT_TRUE(session.snapshot().shown->exact);
}

}  // namespace
}  // namespace pullfocus::cli::preview
