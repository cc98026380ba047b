// Whole files or none.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <string>
#include <vector>

#include "exr/channels.h"
#include "exr/extra.h"
#include "image/frame.h"

namespace pullfocus::exr {

// Samples of one channel over the header's data window. The writer does not own them.
struct OutputChannel {
  std::string name;
  Imf::PixelType type = Imf::HALF;
  const std::byte* base = nullptr;         // sample of the data window's top left pixel
  std::size_t x_stride = 0, y_stride = 0;  // bytes from a sample to the next one to the right, and below
};

// R, G, B and, if selected, A of `colour` under their output names. `data_window` must lie inside colour's
// window.
std::vector<OutputChannel> colour_channels(const ColourImage& colour, const Selection& selection,
                                           const Window& data_window);

// All channels of `extra`, over its own window.
std::vector<OutputChannel> extra_channels(const ExtraChannels& extra);

// Writes a scanline file with `header`'s attributes, window and compression, and exactly `channels`. The file
// grows under `name.XXXXXXXX.temp.exr` in the same folder and is renamed when complete, so `path` is the old
// file or the whole new one, never anything between. Compression uses as many threads as OpenEXR was set to
// by the program. Throws Error(unwritable) with the system's reason; nothing is left behind then.
void write_exr(const std::string& path, const Imf::Header& header, const std::vector<OutputChannel>& channels);

}  // namespace pullfocus::exr
