// Reading test images and holding the frames against them.
#pragma once

#include <cstddef>
#include <string>

#include "exr/exr_files.h"
#include "exr/reader.h"

namespace pullfocus::exr::test {

// Compares every pixel of the frame with the image's, or with "no data" outside its data window.
void expect_frame(const Frame& frame, const TestImage& image, const std::string& prefix = "");

struct Read {
  Frame frame;
  ExtraChannels extra;
  std::size_t outside = 0;
};

// Writes the image to a scanline file and reads it over the state window.
Read read_scanlines(const TestImage& image, const Window& state, const ChannelOptions& options = {});

}  // namespace pullfocus::exr::test
