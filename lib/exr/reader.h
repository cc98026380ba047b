// Pixels of one frame.
#pragma once

#include <OpenEXR/ImfForward.h>

#include <cstddef>
#include <memory>
#include <string>

#include "exr/channels.h"
#include "exr/extra.h"
#include "exr/file_info.h"
#include "image/frame.h"

namespace pullfocus::exr {

// An opened file: the header first, then, with a selection made from it, the pixels. Scanline or tiled; of
// several resolutions the full one. Decompression uses as many threads as OpenEXR was set to by the program.
class FrameReader {
 public:
  explicit FrameReader(const std::string& path);  // throws as read_header()
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  const FileInfo& info() const noexcept { return info_; }

  // Fills `frame` over `state_window` (not empty), reusing its memory:
  //   colour  half if all selected colour channels are half, else float32; as stored, neither clamped nor
  //           repaired; 0 where the file has no data
  //   A       1 everywhere if the selection has no alpha channel, else as stored and 0 without data
  //   depth   float, converted from half, float or uint; +infinity where the file has no data
  //           or the selection no depth
  //   mask    as depth if the selection has one, 0 where the file has no data; else none
  // `extra` gets the other selected channels over the part of the data window inside the state window (null:
  // none). Returns the number of the file's pixels outside the state window, which are ignored.
  // Throws Error(unreadable): a selected channel is missing, or the pixels are incomplete or damaged; `frame`
  // and `extra` then hold anything.
  std::size_t read(const Selection& selection, const Window& state_window, Frame& frame, ExtraChannels* extra);

 private:
  FileInfo info_;
  std::unique_ptr<Imf::MultiPartInputFile> file_;
};

// Opens the file, selects its channels and reads it; returns what read() returns.
std::size_t read_frame(const std::string& path, const ChannelOptions& options, const Window& state_window, Frame& frame,
                       ExtraChannels* extra);

}  // namespace pullfocus::exr
