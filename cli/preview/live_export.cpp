// Of a session: what leaves it, as files.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "frame_writer.h"
#include "image/error.h"
#include "imageio/picture.h"
#include "preview/command_text.h"
#include "preview/live_session.h"

namespace pullfocus::cli::preview {

namespace {

bool is_exr(const std::string& file) { return file.ends_with(".exr") || file.ends_with(".EXR"); }

imageio::Picture to_picture(const ColourImage& colour, float exposure) {
  const Window& w = colour.window();
  const float factor = std::exp2(exposure);
  imageio::Picture picture{w.width(), w.height(), {}};
  picture.rgba.reserve(w.pixels() * 4);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 4; ++c) picture.rgba.push_back(colour.get(x, y, c) * (c < 3 ? factor : 1));
    }
  }
  return picture;
}

// As `filter` writes an EXR file, with all its channels; any other format holds the state window, with an exposure.
void write_frame(const Shot& shot, const std::string& file, const Wish& wish, const ColourImage& colour,
                 const Window& window, float exposure) {
  if (!is_exr(file)) return imageio::write_picture(file, to_picture(colour, exposure));
  const exr::SequenceFrame& from = shot.sequence().frames[wish.frame];
  ShotFrame read;
  shot.read(from, read, true);
  exr::ExtraChannels scratch;
  const FrameWriter writer(shot, *wish.camera, file, std::nullopt, {from.frame});
  writer.write_colour(from.frame, read, wish.setup->method, colour, window, scratch);
}

}  // namespace

void LiveSession::save_keys(const std::string& file) {
  save_camera_keys(choice_.keys, file);
  std::error_code ignored;
  if (!(autosaved_ == saved_)) std::filesystem::remove(autosave_file(keys_file_), ignored);
  saved_ = autosaved_ = choice_.keys;
  keys_file_ = file;
  say("saved camera keys to " + file);
}

// A key file is small: written here, so that the last one written is the last one chosen.
void LiveSession::autosave(double seconds) {
  if (choice_.keys == saved_ || choice_.keys == autosaved_ || seconds - autosaved_at_ < 1) return;
  autosaved_at_ = seconds;
  autosaved_ = choice_.keys;
  try {
    save_camera_keys(choice_.keys, autosave_file(keys_file_));
  } catch (const Error& error) {
    say(error.what(), true);
  }
}

// The engine makes the exact picture; another thread writes it.
void LiveSession::export_frame(const std::string& name) {
  if (name.empty()) throw Error(ErrorCode::usage, "export: give a file, such as frame.exr or frame.####.png");
  const std::string file = exr::Pattern::parse(name).path(number());
  if (is_exr(file)) {
    const exr::OutputNames names(file, open_->shot.sequence().pattern, {number()});
    names.require_folder();
  }
  Wish wish = make_wish(false);
  const float exposure = look_.exposure;
  open_->engine.finish(
      wish, [this, shot = open_->kept, file, wish, exposure](const Exact* exact, const std::string& problem) {
        const int number = shot->sequence().frames[wish.frame].frame;
        if (exact == nullptr) return say(fmt::format("{}: not written: frame {}: {}", file, number, problem), true);
        jobs_.add([this, shot, file, wish, exposure, colour = exact->colour, window = exact->window] {
          try {
            write_frame(*shot, file, wish, colour, window, exposure);
            say(fmt::format("wrote frame {} to {}", shot->sequence().frames[wish.frame].frame, file));
          } catch (const std::exception& error) {
            say(error.what(), true);
          }
        });
      });
  wish.id = ++request_;  // and on from there
  open_->engine.want(std::move(wish));
}

void LiveSession::export_shot(const std::string& out) {
  if (out.empty())
    throw Error(ErrorCode::usage, "export-shot: give a folder or a pattern, such as out/ or out.####.exr");
  if (shot_run_ && !shot_run_->is_over()) {
    throw Error(ErrorCode::usage, "export-shot: a shot is being written: wait for it, or cancel");
  }
  std::vector<std::string> words =
      filter_arguments(arguments_.input, arguments_.camera, choice_.keys, filter_of(choice_), out);
  words.insert(words.end(), {"--stats", "-", "--mkdir", "--skip-bad-frames"});
  shot_run_ = nullptr;
  shot_run_ = std::make_unique<FilterProcess>(words, open_->shot.sequence().frames.size(), [this] { changed(); });
  say("writing the shot to " + out);
}

// Says how a shot being written has ended.
void LiveSession::watch_shot() {
  if (!shot_run_ || !shot_run_->is_over()) return;
  const int code = shot_run_->exit_code();
  if (code == 0) {
    say("the shot is written");
  } else {
    say(fmt::format("the shot is not complete: {}",
                    shot_run_->last_error().empty() ? fmt::format("exit code {}", code) : shot_run_->last_error()),
        true);
  }
  shot_run_ = nullptr;
}

}  // namespace pullfocus::cli::preview
