// The files that `pullfocus render` writes.
#pragma once

#include <string>

#include "camera/thin_lens.h"
#include "image/frame.h"
#include "render/renderer.h"

namespace pullfocus::cli {

// What the header says of how a frame was taken.
struct Taken {
  ThinLens lens;
  double sensor_height_mm = 0;
  bool has_lens = true;  // else only focal length and sensor are known
  std::string comment;
};

// Colour as half RGB, depth as float Z, and the lens in the header, so that `filter` needs no camera options but
// --lens.
void write_picture_and_depth(const std::string& path, const Taken& taken, const Frame& frame);
void write_truth(const std::string& path, const Taken& taken, const ColourImage& colour);  // RGB as it is stored
void write_deep(const std::string& path, const Taken& taken, const sequences::DeepPixels& pixels);

}  // namespace pullfocus::cli
