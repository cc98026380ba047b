// Channels that are carried along without being looked at.
#pragma once

#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <string>
#include <vector>

#include "image/window.h"

namespace pullfocus::exr {

std::size_t sample_bytes(Imf::PixelType type) noexcept;

// One channel over the window of its ExtraChannels: samples as stored, rows top down, no padding.
struct ExtraChannel {
  std::string name;  // in the output
  Imf::PixelType type = Imf::HALF;
  std::vector<std::byte> samples;

  bool operator==(const ExtraChannel&) const = default;
};

struct ExtraChannels {
  Window window;
  std::vector<ExtraChannel> channels;

  // Sets window and channel count; samples hold anything. Reuses memory where it suffices.
  void reset(const Window& new_window, std::size_t count);
};

// The same channels over `window`, with zeros where `extra` has no samples.
ExtraChannels pass_through(const ExtraChannels& extra, const Window& window);

// The same without a copy where the windows are equal: either `extra` itself, or `scratch`, whose memory is used again.
const ExtraChannels& pass_through(const ExtraChannels& extra, const Window& window, ExtraChannels& scratch);

}  // namespace pullfocus::exr
