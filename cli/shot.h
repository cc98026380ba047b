// The input of a command: a sequence on disk, opened, with its camera and state window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera_options.h"
#include "exr/reader.h"
#include "exr/sequence.h"
#include "exr/state_window.h"
#include "filter_options.h"

namespace CLI {
class App;
}

namespace pullfocus::cli {

struct InputArguments {
  std::string input;
  std::optional<std::string> frames, layer, view, depth_channel, mask;
  std::string overscan = "auto";
  bool repair_depth = false;
};
void add_input_options(CLI::App& app, InputArguments& arguments);

// One frame as read.
struct ShotFrame {
  exr::FileInfo file;
  exr::Selection selection;
  Frame frame;
  exr::ExtraChannels extra;
  std::size_t outside = 0;  // the file's pixels outside the state window
  std::int64_t mixed = 0;   // depths that --repair-depth replaced
};

class Shot {
 public:
  // Finds the files and reads their headers; resolves --focus-at. Throws Error.
  Shot(const InputArguments& input, const CameraArguments& camera, exr::BadFrames bad_frames);

  const exr::Sequence& sequence() const noexcept { return sequence_; }
  const Window& state_window() const noexcept { return state_window_; }
  const Camera& camera() const noexcept { return camera_; }
  std::vector<int> frame_numbers() const;
  ShotFacts facts() const;  // of the first frame

  // Reads frame number `i` of sequence().frames, reusing memory of `out`. Errors name frame and file.
  void read(const exr::SequenceFrame& from, ShotFrame& out, bool with_extra) const;

  bool repairs_depth() const noexcept { return repair_depth_; }
  std::string describe(const ShotFrame& frame) const;  // mask and repair, for the output's header; empty: neither

 private:
  exr::ChannelOptions channels_;
  exr::Sequence sequence_;
  Window state_window_;
  Camera camera_;
  bool repair_depth_;

  exr::Selection select(const exr::FileInfo& file) const;
  double depth_at_focus_pixel(const FocusPixel& pixel) const;
};

}  // namespace pullfocus::cli
