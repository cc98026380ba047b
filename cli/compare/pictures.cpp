#include "compare/pictures.h"

#include <fmt/format.h>

#include "exr/reader.h"
#include "image/error.h"

namespace pullfocus::cli {

namespace {

exr::Sequence open(const std::string& pattern, const std::string& frames, const std::string& option) {
  try {
    return exr::open_sequence(exr::Pattern::parse(pattern), frames);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}{}{}", option, option.empty() ? "" : ": ", error.what()));
  }
}

}  // namespace

PictureSequence::PictureSequence(const std::string& pattern, const std::string& frames, const std::string& option,
                                 const exr::ChannelOptions& channels)
    : option_(option), channels_(channels), sequence_(open(pattern, frames, option)) {
  channels_.colour_only = true;
}

const exr::SequenceFrame* PictureSequence::find(int frame, bool only_frame) const noexcept {
  if (only_frame && sequence_.pattern.is_single()) return &sequence_.frames.front();
  for (const exr::SequenceFrame& candidate : sequence_.frames) {
    if (candidate.frame == frame) return &candidate;
  }
  return nullptr;
}

void PictureSequence::read(const exr::SequenceFrame& from, const Window& window, Frame& out) const {
  try {
    exr::read_frame(from.path, channels_, window, out, nullptr);
  } catch (const Error& error) {
    throw Error(error.code(),
                fmt::format("{}{}frame {}: {}", option_, option_.empty() ? "" : ": ", from.frame, error.what()));
  }
}

void PictureSequence::require_window(const Window& w, const std::string& of) const {
  const Window& own = sequence_.display_window;
  if (own == w) return;
  throw Error(
      ErrorCode::usage,
      fmt::format("{} {}: its display window is {}x{} from {},{}, that of {} {}x{} from {},{}: they must be the same",
                  option_, sequence_.pattern.text(), own.width(), own.height(), own.x0, own.y0, of, w.width(),
                  w.height(), w.x0, w.y0));
}

}  // namespace pullfocus::cli
