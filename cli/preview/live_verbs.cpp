// Of a session: the verbs of its actions.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "image/error.h"
#include "preview/live_session.h"

namespace pullfocus::cli::preview {

struct LiveSession::Verb {
  const char* name;
  const char* arguments;  // as help shows them; those in brackets may be missing
  const char* what;
  std::size_t least, most;  // number of arguments
  void (*run)(LiveSession&, const Words&);
};

namespace {

double number_in(const std::string& text, double least, double most, const char* what) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc{} || parsed.ptr != end || !(value >= least && value <= most)) {
    throw Error(ErrorCode::usage, fmt::format("{} '{}' is not a number from {} to {}", what, text, least, most));
  }
  return value;
}

bool on_or_off(const std::string& text, const char* what) {
  if (text == "on") return true;
  if (text == "off") return false;
  throw Error(ErrorCode::usage, fmt::format("{} '{}' is neither on nor off", what, text));
}

View view_of(const std::string& text) {
  for (int i = 0; i < kViews; ++i) {
    if (text == kViewNames[i]) return static_cast<View>(i);
  }
  throw Error(ErrorCode::usage,
              "view '" + text + "' is not known: use result, input, depth, coc, importance or difference");
}

}  // namespace

const std::vector<LiveSession::Verb>& LiveSession::verbs() {
  using S = LiveSession;
  using W = const Words&;
  static const std::vector<Verb> all{
      {"frame", "N", "go to frame N", 1, 1, [](S& s, W w) { s.go_to(s.position_of(w[0])); }},
      {"step", "N", "go N frames ahead, negative: back", 1, 1,
       [](S& s, W w) {
         const double n = number_in(w[0], -1e6, 1e6, "step") + static_cast<double>(s.frame_);
         s.go_to(static_cast<std::size_t>(
             std::clamp(n, 0., static_cast<double>(s.open_->shot.sequence().frames.size() - 1))));
       }},
      {"play", "", "play from the current frame on", 0, 0,
       [](S& s, W) {
         s.playing_ = true;
         s.play_start_.reset();
         s.dropped_ = 0;
         if (s.frame_ + 1 == s.open_->shot.sequence().frames.size()) s.go_to(0);
         s.wish();
       }},
      {"pause", "", "stop playing", 0, 0,
       [](S& s, W) {
         s.playing_ = false;
         s.wish();
       }},
      {"fps", "N", "frames a second when playing", 1, 1,
       [](S& s, W w) {
         s.fps_ = number_in(w[0], 0.1, 240, "fps");
         s.play_start_.reset();
       }},
      {"loop", "on|off", "whether playing begins again at the end", 1, 1,
       [](S& s, W w) { s.loop_ = on_or_off(w[0], "loop"); }},

      {"focus", "VALUE", "distance in focus, scene units or inf; a key if focus has keys", 1, 1,
       [](S& s, W w) { s.set("focus", w[0]); }},
      {"focus-at", "X,Y", "focus on what pixel X,Y shows", 1, 1, [](S& s, W w) { s.focus_at(w); }},
      {"fstop", "VALUE", "f-number", 1, 1, [](S& s, W w) { s.set("fstop", w[0]); }},
      {"focal-length", "VALUE", "in mm", 1, 1, [](S& s, W w) { s.set("focal-length", w[0]); }},
      {"interp", "NAME", "between focus keys: dioptre, distance or smooth", 1, 1,
       [](S& s, W w) {
         Choice choice = s.choice_;
         choice.keys.interpolation = parse_focus_interp(w[0], "interp");
         s.choose(std::move(choice));
       }},
      {"key", "SETTING [FRAME [VALUE]]", "set a key: focus, fstop or focal-length, by default here and as it is", 1, 3,
       [](S& s, W w) { s.set_key(w); }},
      {"unkey", "SETTING [FRAME|all]", "remove a key", 1, 2, [](S& s, W w) { s.remove_key(w); }},
      {"move-key", "SETTING FROM TO", "move a key to another frame", 3, 3, [](S& s, W w) { s.move_key(w); }},
      {"hold", "", "a drag begins: what follows is one step for undo", 0, 0,
       [](S& s, W) {
         s.holding_ = true;
         s.held_ = false;
       }},
      {"release", "", "it ends", 0, 0,
       [](S& s, W) {
         s.holding_ = s.held_ = false;
         s.wish();  // without hurry
       }},
      {"undo", "", "take the last change of camera or kernel back", 0, 0, [](S& s, W) { s.undo(s.undo_, s.redo_); }},
      {"redo", "", "make it again", 0, 0, [](S& s, W) { s.undo(s.redo_, s.undo_); }},

      {"kernel", "NAME", "as --kernel", 1, 1,
       [](S& s, W w) {
         Choice choice = s.choice_;
         choice.kernel.kernel = w[0];
         s.choose(std::move(choice));
       }},
      {"visibility", "NAME", "as --visibility", 1, 1,
       [](S& s, W w) {
         Choice choice = s.choice_;
         choice.visibility = w[0];
         s.choose(std::move(choice));
       }},
      {"budget", "B", "of each picture, as --budget", 1, 1,
       [](S& s, W w) {
         s.budget_ = Budget::parse(w[0]);
         s.budget_text_ = w[0];
         s.wish();
       }},
      {"refine", "on|off", "whether pictures are refined until they are exact", 1, 1,
       [](S& s, W w) {
         s.refine_ = on_or_off(w[0], "refine");
         s.wish();
       }},

      {"view", "NAME", "result, input, depth, coc, importance or difference", 1, 1,
       [](S& s, W w) {
         s.look_.view = view_of(w[0]);
         s.wish();
       }},
      {"exposure", "STOPS", "of the view", 1, 1,
       [](S& s, W w) {
         s.look_.exposure = static_cast<float>(number_in(w[0], -20, 20, "exposure"));
         s.wish();
       }},
      {"srgb", "on|off", "encode the view for an sRGB screen", 1, 1,
       [](S& s, W w) {
         s.look_.srgb = on_or_off(w[0], "srgb");
         s.wish();
       }},
      {"wipe", "SHARE|off", "show the input left of that share of the width", 1, 1,
       [](S& s, W w) {
         s.look_.wipe.reset();
         if (w[0] != "off") s.look_.wipe = static_cast<float>(number_in(w[0], 0, 1, "wipe"));
         s.wish();
       }},
      {"live", "on|off", "whether files that are new or written again are taken in", 1, 1,
       [](S& s, W w) { s.live_ = on_or_off(w[0], "live"); }},
      {"reload", "", "read the current frame's file again", 0, 0,
       [](S& s, W) {
         s.open_->cache.forget(s.frame_);
         s.wish();
       }},

      {"save-keys", "[FILE]", "save the camera's keys", 0, 1,
       [](S& s, W w) { s.save_keys(w.empty() ? s.keys_file_ : w[0]); }},
      {"load-keys", "FILE", "take keys from a file", 1, 1,
       [](S& s, W w) {
         Choice choice = s.choice_;
         choice.keys = load_camera_keys(w[0]);
         s.choose(std::move(choice));
         if (w[0].ends_with(".autosave")) return;  // not a place to save to
         s.saved_ = s.autosaved_ = s.choice_.keys;
         s.keys_file_ = w[0];
       }},
      {"export", "FILE", "write the current frame: .exr as filter writes it, .png and others as the result is viewed",
       1, 1, [](S& s, W w) { s.export_frame(w[0]); }},
      {"export-shot", "OUT", "run pullfocus filter over the shot", 1, 1, [](S& s, W w) { s.export_shot(w[0]); }},
      {"cancel", "", "stop writing the shot", 0, 0,
       [](S& s, W) {
         if (s.shot_run_) s.shot_run_->stop();
       }},
  };
  return all;
}

std::string LiveSession::help() {
  std::string text;
  for (const Verb& verb : verbs()) {
    text += fmt::format("  {:<32} {}\n", fmt::format("{} {}", verb.name, verb.arguments), verb.what);
  }
  return text;
}

void LiveSession::perform(const Action& action) {
  const auto verb = std::find_if(verbs().begin(), verbs().end(), [&](const Verb& v) { return v.name == action.verb; });
  if (verb == verbs().end()) throw Error(ErrorCode::usage, "'" + action.verb + "' is no action");
  if (action.arguments.size() < verb->least || action.arguments.size() > verb->most) {
    throw Error(ErrorCode::usage, fmt::format("{}: usage: {} {}", verb->name, verb->name, verb->arguments));
  }
  if (record_.is_open()) record_ << to_line(action) << std::endl;
  verb->run(*this, action.arguments);
}

}  // namespace pullfocus::cli::preview
