// The window itself, end to end: under a virtual display, with mouse and keyboard, drawn by software. Without Xvfb and
// xdotool these tests are skipped.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "imageio/picture.h"
#include "live_shot.h"

namespace pullfocus::cli::preview {
namespace {

using pullfocus::test::shared_data;
using test::TempFolder;

bool is_there(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

void pause_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

// Settings for the window's process. With the address sanitizer, the software driver, which leaks a little and is
// unloaded before that is looked at, stays loaded, so that its leaks can be told from the program's by its name.
std::string environment([[maybe_unused]] const TempFolder& folder) {
#ifdef __SANITIZE_ADDRESS__
  const char* const driver = "/usr/lib/x86_64-linux-gnu/dri/swrast_dri.so";
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::filesystem::exists(driver) && std::getline(maps, line);) {
    if (line.find("libasan.so") == std::string::npos) continue;
    std::ofstream(folder / "leaks.txt") << "leak:swrast_dri.so\n";
    return fmt::format("LIBGL_ALWAYS_SOFTWARE=1 LD_PRELOAD='{} {}' LSAN_OPTIONS='suppressions={} print_suppressions=0'",
                       line.substr(line.find('/')), driver, folder / "leaks.txt");
  }
#endif
  return "LIBGL_ALWAYS_SOFTWARE=1";
}

// A process of its own, with what it says in a file.
class Process {
 public:
  Process(const std::string& command, const std::string& log) {
    id_ = fork();
    if (id_ == 0) {
      setpgid(0, 0);
      execl("/bin/sh", "sh", "-c", ("exec " + command + " >'" + log + "' 2>&1 </dev/null").c_str(), nullptr);
      _exit(127);
    }
  }
  ~Process() {
    if (!over_) {
      kill(id_, SIGKILL);
      waitpid(id_, nullptr, 0);
    }
  }
  void signal(int number) const { kill(id_, number); }
  // Exit code, or -1 if it has not ended after `seconds`.
  int wait(int seconds) {
    for (int i = 0; i < seconds * 100; ++i, pause_ms(10)) {
      int status = 0;
      if (waitpid(id_, &status, WNOHANG) != id_) continue;
      over_ = true;
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return -1;
  }

 private:
  pid_t id_ = -1;
  bool over_ = false;
};

class PreviewWindow : public testing::Test {
 protected:
  static constexpr int kWidth = 1280, kHeight = 800;

  void SetUp() override {
    if (!is_there("Xvfb") || !is_there("xdotool")) GTEST_SKIP() << "Xvfb and xdotool are needed";
    // The server names a display that is free. It must not reset when its last client leaves, as each xdotool is for a
    // while: who comes during a reset is turned away.
    const std::string number = folder / "display";
    screen.emplace("Xvfb -displayfd 3 -noreset -screen 0 1400x900x24 +extension GLX -nolisten tcp 3>'" + number + "'",
                   folder / "xvfb.log");
    std::string text;
    for (int i = 0; i < 1000 && text.find('\n') == std::string::npos; ++i, pause_ms(10)) text = read(number);
    ASSERT_NE(text, "") << read(folder / "xvfb.log");
    display = fmt::format(":{}", text.substr(0, text.find('\n')));
  }
  void TearDown() override {
    window.reset();
    if (screen) {
      screen->signal(SIGTERM);
      screen->wait(20);
    }
  }

  static std::string read(const std::string& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  // Opens it, and waits until it is drawn.
  void opens(const std::string& arguments) {
    window.emplace("env DISPLAY=" + display + " " + environment(folder) + " '" PULLFOCUS_PROGRAM "' preview " +
                       arguments + " --threads 2 --window-size 1280x800 --record '" + (folder / "done.txt") +
                       "' --keys '" + (folder / "keys.toml") + "'",
                   folder / "window.log");
    for (int i = 0; i < 600; ++i) {
      if (does("search --onlyvisible --name '^pullfocus'") == 0) break;
      pause_ms(50);
    }
    pause_ms(1000);
  }
  int does(const std::string& what) const {
    return std::system(("DISPLAY=" + display + " xdotool " + what + " >/dev/null 2>&1").c_str());
  }
  void presses(const std::string& key) const {
    does("keydown " + key + " sleep 0.15 keyup " + key);
    pause_ms(150);
  }
  void drags(int x0, int y0, int x1, int y1) const {
    std::ostringstream line;
    line << "mousemove " << x0 << " " << y0 << " sleep 0.15 mousedown 1 sleep 0.15";
    for (int i = 1; i <= 5; ++i)
      line << " mousemove " << x0 + (x1 - x0) * i / 5 << " " << y0 + (y1 - y0) * i / 5 << " sleep 0.08";
    line << " mouseup 1 sleep 0.15";
    does(line.str());
  }
  // What the recording says has been done; waits until it holds `text`.
  std::string done(const std::string& text) const {
    std::string all;
    for (int i = 0; i < 1500 && all.find(text) == std::string::npos; ++i, pause_ms(20)) all = read(folder / "done.txt");
    EXPECT_NE(all.find(text), std::string::npos) << text << " is not in\n" << all << read(folder / "window.log");
    return all;
  }
  void waits_for(const std::string& file) const {
    for (int i = 0; i < 3000 && !std::filesystem::exists(file); ++i) pause_ms(20);
    EXPECT_TRUE(std::filesystem::exists(file)) << file << read(folder / "window.log");
  }
  void looks(const std::string& name) const {
    if (const char* keep = std::getenv("PULLFOCUS_SCREENSHOTS")) {
      std::system(
          ("DISPLAY=" + display + " import -window root -crop 1280x800+0+0 '" + keep + "/" + name + ".png'").c_str());
    }
  }
  // A place of the picture of width x height in the window.
  struct Place {
    int x, y;
  };
  static Place place(double x, double y, int width, int height) {
    const double room_x = kWidth - 350, room_y = kHeight - 104 - 44;
    const double zoom = std::min(room_x / width, room_y / height);
    return {static_cast<int>(room_x / 2 + (x - width / 2.) * zoom),
            static_cast<int>(room_y / 2 + (y - height / 2.) * zoom)};
  }

  TempFolder folder;
  std::optional<Process> screen, window;
  std::string display;
};

TEST_F(PreviewWindow, FocusesDragsSetsKeysPlaysAndExportsTheStarShotAsFilterDoes) {
  const std::string shot = folder / "star/star-lateral.####.exr";
  ASSERT_EQ(
      pullfocus::test::run("render star-lateral -o '" + (folder / "star") + "' --size 256x160 --frames 1-12").code, 0);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(static_cast<std::string>(folder / ""));
  opens("'" + shot + "' --fstop 2 --focal-length 50 --focus 2");
  std::filesystem::current_path(before);
  const Place star = place(128, 80, 256, 160), wall = place(20, 20, 256, 160);
  drags(wall.x, wall.y, star.x, star.y);
  const std::string dragged = done("release");
  EXPECT_TRUE(dragged.starts_with("hold\nfocus-at ")) << dragged;
  presses("k");
  done("key focus");
  presses("End");
  done("frame 12");
  drags(wall.x, wall.y, wall.x + 2, wall.y);
  presses("k");
  looks("star-keys");
  presses("space");
  done("play");
  pause_ms(1500);
  presses("space");
  done("pause");
  presses("Home");
  presses("Right");
  presses("Right");
  presses("2");
  presses("1");
  presses("e");
  done("export preview.####.exr");
  waits_for(folder / "preview.0003.exr");
  presses("ctrl+s");
  done("save-keys");
  waits_for(folder / "keys.toml");
  presses("ctrl+q");
  EXPECT_EQ(window->wait(60), 0) << read(folder / "window.log");
  EXPECT_EQ(read(folder / "window.log"), "");
  ASSERT_EQ(pullfocus::test::run("filter '" + shot + "' -o '" + (folder / "ref.exr") +
                                 "' --frames 3 --fstop 2 --focal-length 50 --focus '@" + (folder / "keys.toml") + "'")
                .code,
            0);
  EXPECT_EQ(exr::test::file_bytes(folder / "preview.0003.exr"), exr::test::file_bytes(folder / "ref.exr"));
}

TEST_F(PreviewWindow, DoesTheSameWithTheBeachballAndAsksAboutKeysThatAreNotSaved) {
  const std::string data = shared_data("beachball/singlepart.0001.exr");
  if (data.empty()) GTEST_SKIP() << "../shared/data/beachball is not there";
  const std::string input = fmt::format("'{}####.exr' --view left", data.substr(0, data.size() - 8));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(static_cast<std::string>(folder / ""));
  opens(input + " --fstop 2 --focal-length 50 --focus 5 --frames 1-4 -o '" + (folder / "shot/") + "'");
  const Place ball = place(1000, 700, 2310, 1556);
  drags(ball.x, ball.y, ball.x + 20, ball.y + 10);
  done("release");
  presses("k");
  presses("End");
  done("frame 4");
  pause_ms(1000);
  const Place rim = place(850, 600, 2310, 1556);
  drags(rim.x, rim.y, rim.x + 4, rim.y);
  presses("k");
  presses("Home");
  presses("space");
  done("play");
  pause_ms(2000);
  presses("space");
  done("pause");
  presses("Home");
  presses("Right");
  done("step 1");
  pause_ms(500);
  presses("e");
  done("export preview.####.exr");
  waits_for(folder / "preview.0002.exr");
  looks("beachball");
  presses("ctrl+e");
  waits_for(folder / "shot/singlepart.0004.exr");
  presses("4");
  looks("beachball-coc");
  // Keys are not saved: it asks, and Escape takes the question back.
  presses("ctrl+q");
  EXPECT_EQ(window->wait(1), -1);
  presses("Escape");
  EXPECT_EQ(window->wait(1), -1);
  presses("ctrl+q");
  presses("Return");
  EXPECT_EQ(window->wait(60), 0) << read(folder / "window.log");
  std::filesystem::current_path(before);
  ASSERT_TRUE(std::filesystem::exists(folder / "keys.toml"));
  ASSERT_EQ(pullfocus::test::run("filter " + input + " -o '" + (folder / "ref/") + "' --mkdir --frames 1-4 --fstop 2 " +
                                 "--focal-length 50 --focus '@" + (folder / "keys.toml") + "'")
                .code,
            0);
  EXPECT_EQ(exr::test::file_bytes(folder / "preview.0002.exr"),
            exr::test::file_bytes(folder / "ref/singlepart.0002.exr"));
  EXPECT_EQ(exr::test::file_bytes(folder / "shot/singlepart.0004.exr"),
            exr::test::file_bytes(folder / "ref/singlepart.0004.exr"));
}

TEST_F(PreviewWindow, ClosesWhileItReadsAndRefines) {
  const std::string shot = folder / "star/star-lateral.####.exr";
  ASSERT_EQ(pullfocus::test::run("render star-lateral -o '" + (folder / "star") + "' --size 960x540 --frames 1-6").code,
            0);
  for (int i = 0; i < 2; ++i) {
    opens("'" + shot + "' --fstop 1 --focal-length 80 --focus 2 --budget 1ms");
    presses("space");
    does("mousemove 300 300 mousedown 1 sleep 0.1 mousemove 320 310 sleep 0.1 mouseup 1");
    presses("ctrl+z");  // nothing to save
    presses("ctrl+q");
    EXPECT_EQ(window->wait(60), 0) << read(folder / "window.log");
    EXPECT_EQ(read(folder / "window.log"), "");
  }
}

TEST_F(PreviewWindow, SaysInOneLineWhatIsWrongWithTheShot) {
  window.emplace("env DISPLAY=" + display + " '" PULLFOCUS_PROGRAM "' preview '" + (folder / "none.####.exr") + "'",
                 folder / "window.log");
  EXPECT_EQ(window->wait(60), 1);
  EXPECT_NE(read(folder / "window.log").find("none.####.exr"), std::string::npos);
}

TEST_F(PreviewWindow, SaysSoWhereThereIsNoOpenGl) {
  const test::LiveShot files(1);
  window.emplace("env DISPLAY=" + display +
                     " LIBGL_ALWAYS_SOFTWARE=1 MESA_GL_VERSION_OVERRIDE=1.4 '" PULLFOCUS_PROGRAM "' preview '" +
                     files.pattern() + "'",
                 folder / "window.log");
  EXPECT_EQ(window->wait(60), 1);
  const std::string said = read(folder / "window.log");
  EXPECT_NE(said.find("OpenGL"), std::string::npos) << said;
  EXPECT_NE(said.find("--headless"), std::string::npos) << said;
}

}  // namespace
}  // namespace pullfocus::cli::preview
