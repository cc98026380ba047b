// EXR sequences that are only looked at: truth, references, and what --given names.
#pragma once

#include <optional>
#include <string>

#include "exr/sequence.h"
#include "image/frame.h"
#include "shot.h"

namespace pullfocus::cli {

class PictureSequence {
 public:
  // `option` is named in errors. Throws Error.
  PictureSequence(const std::string& pattern, const std::string& frames, const std::string& option,
                  const exr::ChannelOptions& channels = {});

  const exr::Sequence& sequence() const noexcept { return sequence_; }

  // Null if the sequence has no such frame. A single file is the picture of whatever single frame it is compared to.
  const exr::SequenceFrame* find(int frame, bool only_frame) const noexcept;

  // RGBA over `window`, 0 where the file has no data; reuses memory. Throws Error naming frame and file.
  void read(const exr::SequenceFrame& from, const Window& window, Frame& out) const;

  // Throws Error(usage) if the display window is another.
  void require_window(const Window& display_window, const std::string& of) const;

 private:
  std::string option_;
  exr::ChannelOptions channels_;
  exr::Sequence sequence_;
};

}  // namespace pullfocus::cli
