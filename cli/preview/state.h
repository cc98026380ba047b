// What the preview shows at a moment: plain data, all that a window needs to draw.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "filter/left_over.h"
#include "key_file.h"

namespace pullfocus::cli::preview {

enum class View { result, input, depth, coc, importance, difference };
inline constexpr int kViews = 6;
// As actions spell them; those that follow from a window's list of names go by the same order.
inline constexpr const char* kViewNames[kViews] = {"result", "input", "depth", "coc", "importance", "difference"};

// How a picture is brought to the screen.
struct Look {
  View view = View::result;
  float exposure = 0;         // stops
  bool srgb = true;           // false: linear values as they are
  std::optional<float> wipe;  // left of this share of the width: the input
  bool operator==(const Look&) const = default;
};

// 8-bit RGBA as the screen takes it, R in the lowest byte; rows top down. The pixels of the state window.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgba;
};

// The last picture of the filter, and how far it is.
struct Shown {
  std::uint64_t request = 0;               // it belongs to
  std::size_t frame = 0;                   // position in the shot
  std::shared_ptr<const Picture> picture;  // null before the first
  std::uint64_t picture_id = 0;            // another number, another picture
  bool exact = false;                      // nothing is left over
  LeftOver left;                           // empty if exact
  double first_ms = 0, total_ms = 0;       // filter time for this frame and lens: to the first picture, up to now
  int calls = 0;                           // of the filter for these
  float depth_near = 0, depth_far = 0;     // of the frame's surfaces; 0: it has none
  std::string problem;                     // why there is no (better) picture; empty: none
};

// A camera setting at the current frame.
struct SettingNow {
  std::optional<double> value;  // unset: neither the header nor anyone says it
  std::string source;           // "header", "--focus", ...
};

struct Probe {
  bool inside = false;
  float depth = 0, coc = 0;
  bool background = false, has_coc = false;
  float colour[4] = {};  // of the input, as stored
};

// The state of a session.
struct Snapshot {
  std::shared_ptr<const Shown> shown;
  std::uint64_t request = 0;                                // the last one made
  std::vector<int> frames;                                  // numbers
  std::vector<bool> loaded;                                 // in memory, by position
  std::size_t frame = 0;                                    // position
  bool loading = false;                                     // the current frame is being read
  int window_x0 = 0, window_y0 = 0, width = 0, height = 0;  // state window
  double pixel_aspect = 1;

  CameraKeys keys;
  bool has_lens = true;  // false: the depth is a CoC diameter
  SettingNow focus, fstop, focal_length;
  std::string kernel, visibility, budget;
  bool refine = true;
  Look look;

  bool playing = false, loop = true, live = false;
  double fps = 24;
  std::int64_t dropped = 0;  // frames, since playing began

  bool unsaved = false, can_undo = false, can_redo = false;
  std::string keys_file, command_line;
  std::string message;  // the last one, one line
  bool message_is_error = false;
  std::optional<double> job;     // share done of a shot being written
  int writing = 0;               // frames being written
  std::size_t memory_bytes = 0;  // of the process
  std::string title;
};

}  // namespace pullfocus::cli::preview
