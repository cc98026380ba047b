#include "preview/script.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "command.h"
#include "image/error.h"
#include "image/srgb.h"
#include "imageio/picture.h"

namespace pullfocus::cli::preview {

namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Script {
 public:
  explicit Script(LiveSession& session) : session_(session) {}

  // False: the script ends here.
  bool perform(const Action& action) {
    const auto needs = [&](std::size_t arguments) {
      if (action.arguments.size() == arguments) return;
      throw Error(ErrorCode::usage,
                  fmt::format("{} takes {} argument{}", action.verb, arguments, arguments == 1 ? "" : "s"));
    };
    if (action.verb == "quit") return false;
    if (action.verb == "wait") {
      needs(0);
      wait();
    } else if (action.verb == "show") {
      needs(1);
      show(action.arguments[0]);
    } else if (action.verb == "status") {
      needs(0);
      status();
    } else if (action.verb == "sleep") {
      needs(1);
      const double end = seconds_now() + std::stod(action.arguments[0]) / 1000;
      while (seconds_now() < end && !interrupted()) pass();
    } else {
      // An artist clicks on what is there to be seen.
      while (action.verb == "focus-at" && session_.snapshot().loading && !interrupted()) pass();
      session_.perform(action);
    }
    say_messages();
    return !interrupted();
  }

  int finish() {
    say_messages();
    return failures_ + session_.failures() > 0 ? kFrameFailed : kDone;
  }

 private:
  void pass() {
    session_.tick(seconds_now());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void wait() {
    do {
      pass();
    } while (!interrupted() && (session_.is_playing() || session_.is_writing() || !session_.is_settled()));
    const Snapshot now = session_.snapshot();
    if (now.shown->problem.empty()) return;
    warn(now.shown->problem);
    ++failures_;
  }

  void show(const std::string& file) {
    const std::shared_ptr<const Picture> picture = session_.snapshot().shown->picture;
    if (!picture) throw Error(ErrorCode::usage, "show: there is no picture yet: wait first");
    imageio::Picture out{picture->width, picture->height, {}};
    out.rgba.reserve(picture->rgba.size() * 4);
    for (const std::uint32_t pixel : picture->rgba) {
      for (int c = 0; c < 3; ++c) {
        out.rgba.push_back(srgb_decoded(static_cast<float>(pixel >> (8 * c) & 255) / 255));
      }
      out.rgba.push_back(1);
    }
    imageio::write_picture(file, out);
  }

  void status() {
    const Snapshot s = session_.snapshot();
    const auto value = [](const SettingNow& setting) {
      return setting.value ? nlohmann::json(*setting.value) : nlohmann::json();
    };
    nlohmann::json line{{"frame", s.frames[s.frame]},
                        {"shown", s.frames[s.shown->frame]},
                        {"exact", s.shown->exact},
                        {"pending", s.shown->left.pixels},
                        {"error_bound", s.shown->left.error_bound},
                        {"share", s.shown->left.share},
                        {"calls", s.shown->calls},
                        {"dropped", s.dropped},
                        {"focus", value(s.focus)},
                        {"fstop", value(s.fstop)},
                        {"focal_length", value(s.focal_length)},
                        {"view", kViewNames[static_cast<int>(s.look.view)]},
                        {"unsaved", s.unsaved},
                        {"problem", s.shown->problem},
                        {"command", s.command_line},
                        {"ms", {{"first", s.shown->first_ms}, {"total", s.shown->total_ms}}}};
    std::cout << line.dump() << std::endl;
  }

  void say_messages() {
    for (const std::string& message : session_.take_messages())
      std::fprintf(stderr, "pullfocus: %s\n", message.c_str());
  }

  LiveSession& session_;
  int failures_ = 0;
};

}  // namespace

int run_script(LiveSession& session, const std::string& file) {
  std::ifstream in(file);
  if (!in) throw Error(ErrorCode::unreadable, fmt::format("--headless {}: cannot be read", file));
  Script script(session);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    try {
      const Action action = parse_action(line);
      if (!action.verb.empty() && !script.perform(action)) break;
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}:{}: {}", file, number, error.what()));
    }
  }
  if (session.snapshot().unsaved) warn("keys were changed and not saved (save-keys)");
  return script.finish();
}

}  // namespace pullfocus::cli::preview
