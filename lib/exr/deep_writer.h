// Deep pictures, whole or not at all.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <half.h>

#include <string>
#include <vector>

namespace pullfocus::exr {

// Samples of all pixels, rows top down, nearest first within a pixel; planar depths, premultiplied colour.
struct DeepSamples {
  std::vector<unsigned int> counts;  // one a pixel
  std::vector<float> z, z_back;      // one a sample, as all below
  std::vector<half> r, g, b, a;
};

// A deep scanline file with channels R, G, B, A (half), Z and ZBack (float) over the header's data window; ZIPS, since
// deep files take no other but RLE. In the manner of write_exr(). Throws Error(unwritable).
void write_deep_exr(const std::string& path, const Imf::Header& header, const DeepSamples& samples);

}  // namespace pullfocus::exr
