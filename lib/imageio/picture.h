// Pictures of any format, read and written through OpenImageIO. For EXR sequences there is lib/exr; this is for
// aperture pictures, previews and comparison sheets.
//
// OpenImageIO is loaded on first use, from a module called pullfocus_oiio.so: beside the executable, or in
// ../lib/pullfocus (as installed) or ../../lib/pullfocus of its folder. Functions may be called from several threads.
#pragma once

#include <string>
#include <vector>

#include "image/srgb.h"

namespace pullfocus::imageio {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgba;  // rows top to bottom, 4 linear values a pixel, premultiplied

  const float* pixel(int x, int y) const noexcept {
    return rgba.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
  }
};

// The first image of a file, its data window. Grey is copied to R, G and B; without alpha it is 1. 8-bit samples, and
// others whose file says so, are taken as sRGB-encoded and made linear. Throws Error(unreadable) naming the file.
Picture read_picture(const std::string& path);

// By the name's extension. Formats of integers get 8-bit sRGB (alpha linear, and associated or not as the format wants
// it), values cut to 0..1, NaN as 0; formats of floats get the values as they are. An opaque picture (alpha 1
// everywhere) is written as RGB. The file appears whole or not at all. Throws Error(unwritable) naming the file.
void write_picture(const std::string& path, const Picture& picture);

using pullfocus::srgb_decoded;
using pullfocus::srgb_encoded;

}  // namespace pullfocus::imageio
