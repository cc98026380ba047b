#include <fmt/format.h>

#include "command.h"
#include "compare/pictures.h"
#include "compare/run.h"
#include "compare/thumbnails.h"
#include "exr/range.h"
#include "image/error.h"
#include "progress.h"

namespace pullfocus::cli {

namespace {

// Frames of one that the other lacks.
std::vector<int> missing(const PictureSequence& of, const PictureSequence& in, bool single) {
  std::vector<int> frames;
  for (const auto& frame : of.sequence().frames) {
    if (in.find(frame.frame, single) == nullptr) frames.push_back(frame.frame);
  }
  return frames;
}

void require_same_frames(const PictureSequence& given, const PictureSequence& reference, bool single) {
  const std::string a = given.sequence().pattern.text(), b = reference.sequence().pattern.text();
  const auto lacks = missing(given, reference, single), too_few = missing(reference, given, single);
  if (!lacks.empty()) {
    throw Error(ErrorCode::unreadable, fmt::format("--reference {}: frames {} of {} are missing: choose with --frames",
                                                   b, exr::format_frames(lacks), a));
  }
  if (!too_few.empty()) {
    throw Error(ErrorCode::unreadable, fmt::format("{}: frames {} of --reference {} are missing: choose with --frames",
                                                   a, exr::format_frames(too_few), b));
  }
}

}  // namespace

ShotResult compare_given(const InputArguments& input, const std::string& reference_pattern, const CompareArguments& a) {
  const exr::ChannelOptions channels{input.layer, input.view, {}, true};
  const std::string range = input.frames.value_or("");
  const PictureSequence given(input.input, range, "", channels);
  const bool one = given.sequence().frames.size() == 1;
  const bool file = exr::Pattern::parse(reference_pattern).is_single();
  const PictureSequence reference(reference_pattern, one && file ? "" : range, "--reference", channels);
  reference.require_window(given.sequence().display_window, given.sequence().pattern.text());
  require_same_frames(given, reference, one && reference.sequence().frames.size() == 1);

  ShotResult result;
  result.given = true;
  result.input = given.sequence().pattern.text();
  result.reference = reference_pattern;
  result.peak = a.peak;
  result.window =
      unite(unite(given.sequence().data_union, reference.sequence().data_union), given.sequence().display_window);
  Row& row = result.rows.emplace_back();
  row.method = row.label = "given";
  const auto& frames = given.sequence().frames;
  Frame picture, right;
  Progress progress(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (interrupted()) throw Error(ErrorCode::content, "interrupted: nothing was written");
    given.read(frames[i], result.window, picture);
    reference.read(*reference.find(frames[i].frame, one), result.window, right);
    FrameResult& to = row.frames.emplace_back();
    to.frame = frames[i].frame;
    to.errors[0] = picture_errors(picture.colour, right.colour, result.window, result.peak);
    if (!a.html.empty() && i == frames.size() / 2) {
      result.picture_frame = frames[i].frame;
      result.pictures.push_back(thumbnail("reference", right.colour, result.window));
      row.pictures = {thumbnail("given", picture.colour, result.window),
                      error_thumbnail("FLIP against reference", picture.colour, right.colour, result.window)};
    }
    progress.done(frames[i].frame);
  }
  return result;
}

}  // namespace pullfocus::cli
