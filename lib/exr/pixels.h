// Samples from a file into memory of any layout.
#pragma once

#include <OpenEXR/ImfForward.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <string>
#include <vector>

#include "image/window.h"

namespace pullfocus::exr {

// Where the samples of one channel go: `base` takes the top left pixel of the window that is read. OpenEXR
// converts where the file's type is another.
struct ChannelTarget {
  std::string channel;
  Imf::PixelType type;
  std::byte* base;
  std::size_t x_stride, y_stride;  // bytes
};

// Reads `window`, which must lie inside the file's `data_window`. Straight into the targets if it is as wide
// as the data; else through scratch memory. Throws what OpenEXR throws.
void read_pixels(Imf::MultiPartInputFile& file, const std::vector<ChannelTarget>& targets, const Window& data_window,
                 const Window& window);

}  // namespace pullfocus::exr
