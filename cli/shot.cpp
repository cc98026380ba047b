#include "shot.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "camera/depth_repair.h"
#include "command.h"
#include "exr/range.h"
#include "image/error.h"

namespace pullfocus::cli {

void add_input_options(CLI::App& app, InputArguments& a) {
  const char* group = "Input";
  app.add_option("input", a.input, "frames: shot.####.exr, shot.%04d.exr, shot.1-100#.exr, or one file")
      ->required()
      ->type_name("IN");
  app.add_option("--frames", a.frames, "which frames, such as 1-10,12-100x2 (default: all that are there)")
      ->group(group);
  app.add_option("--layer", a.layer, "colour layer, such as ViewLayer.Combined (default: found by name)")->group(group);
  app.add_option("--view", a.view, "view of a multi-view file (default: its first)")->group(group);
  app.add_option("--depth-channel", a.depth_channel, "depth channel by its full name (default: found by name)")
      ->group(group);
  app.add_flag("--repair-depth", a.repair_depth,
               "snap depths that a filter mixed at edges to the surface they belong to (inspect tells whether any are)")
      ->group(group);
  app.add_option("--mask", a.mask, "holdout channel: where it is at least 0.5, pixels neither blur nor receive")
      ->type_name("CHANNEL")
      ->group(group);
  app.add_option("--overscan", a.overscan, "room around the display window: auto (all data of the shot) or L,T,R,B")
      ->group(group)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
      ->capture_default_str();
}

namespace {

exr::Sequence open(const InputArguments& input, exr::BadFrames bad_frames) {
  if (input.frames && input.frames->empty()) {
    throw Error(ErrorCode::usage, "--frames is empty: give frames such as 1-10, or leave it out");
  }
  return exr::open_sequence(exr::Pattern::parse(input.input), input.frames.value_or(""), bad_frames);
}

}  // namespace

Shot::Shot(const InputArguments& input, const CameraArguments& camera, exr::BadFrames bad_frames)
    : channels_{.layer = input.layer, .view = input.view, .depth_channel = input.depth_channel, .mask = input.mask},
      sequence_((exr::parse_overscan(input.overscan), open(input, bad_frames))),
      state_window_(
          exr::state_window(sequence_.display_window, sequence_.data_union, exr::parse_overscan(input.overscan))),
      camera_(camera),
      repair_depth_(input.repair_depth) {
  if (!sequence_.gaps.empty()) {
    warn(fmt::format("{}: frames {} are missing between the first and the last", sequence_.pattern.text(),
                     exr::format_frames(sequence_.gaps)));
  }
  if (camera_.focus_pixel()) camera_.set_focus(depth_at_focus_pixel(*camera_.focus_pixel()));
}

ShotFacts Shot::facts() const {
  const exr::FileInfo& first = sequence_.first;
  ShotFacts facts{static_cast<double>(first.pixel_aspect), first.chromaticities, {}};
  if (camera_.depth_kind() != DepthKind::coc) {
    const ThinLens lens = camera_.lens(sequence_.frames.front().frame, first).lens;
    facts.focal_length_px = lens.focal_length_mm * pixels_per_mm(lens, raster_of(first));
  }
  return facts;
}

std::vector<int> Shot::frame_numbers() const {
  std::vector<int> numbers;
  for (const auto& frame : sequence_.frames) numbers.push_back(frame.frame);
  return numbers;
}

void Shot::read(const exr::SequenceFrame& from, ShotFrame& out, bool with_extra) const {
  try {
    exr::FrameReader reader(from.path);
    out.file = reader.info();
    if (out.file.display_window != sequence_.display_window) {
      throw Error(ErrorCode::unreadable, fmt::format("{}: the display window changed since the run began", from.path));
    }
    out.selection = select(out.file);
    out.outside = reader.read(out.selection, state_window_, out.frame, with_extra ? &out.extra : nullptr);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("frame {}: {}", from.frame, error.what()));
  }
  out.mixed = repair_depth_ ? repair_depth(out.frame, camera_.depth_kind()) : 0;
}

// Options that fit the shot's first file are right: then it is the file that is wrong, a bad frame.
exr::Selection Shot::select(const exr::FileInfo& file) const {
  try {
    return exr::select_channels(file.channel_names(), channels_);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::usage || file.path == sequence_.first.path) throw;
    exr::select_channels(sequence_.first.channel_names(), channels_);
    throw Error(ErrorCode::unreadable, error.what());
  }
}

std::string Shot::describe(const ShotFrame& frame) const {
  std::string text;
  if (!frame.selection.mask.empty()) text += fmt::format(" mask=\"{}\"", frame.selection.mask);
  if (repair_depth_) text += fmt::format(" repair_depth=1 repaired_depths={}", frame.mixed);
  return text;
}

// The shot's first frame, not the first one of --frames: every chunk of a shot must focus alike.
double Shot::depth_at_focus_pixel(const FocusPixel& pixel) const {
  if (camera_.depth_kind() == DepthKind::coc) {
    throw Error(ErrorCode::usage, "--focus-at needs depth, and --depth-kind coc has none: leave --focus-at out");
  }
  if (!state_window_.contains(pixel.x, pixel.y)) {
    throw Error(ErrorCode::usage,
                fmt::format("--focus-at {},{} lies outside the picture: x is {} to {}, y {} to {}", pixel.x, pixel.y,
                            state_window_.x0, state_window_.x1 - 1, state_window_.y0, state_window_.y1 - 1));
  }
  const exr::Pattern& pattern = sequence_.pattern;
  const int frame = pixel.frame           ? *pixel.frame
                    : pattern.is_single() ? pattern.single_frame()
                                          : pattern.discover().front();
  ShotFrame read_frame;
  read({frame, pattern.path(frame), {}, {}}, read_frame, false);
  const float depth = read_frame.frame.depth.at(pixel.x, pixel.y);
  if (is_background(camera_.depth_kind(), depth)) {
    warn(fmt::format("--focus-at {},{}: frame {} shows background there: focus is at infinity", pixel.x, pixel.y,
                     frame));
    return std::numeric_limits<double>::infinity();
  }
  return static_cast<double>(depth);
}

}  // namespace pullfocus::cli
