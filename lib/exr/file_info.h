// What a file's header says.
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "exr/channels.h"
#include "image/window.h"
#include "importance/colour_space.h"

namespace pullfocus::exr {

// Larger images are taken for damaged headers and refused: OpenEXR allocates whole rows on a header's word.
constexpr std::size_t max_image_pixels = std::size_t{1} << 28;
constexpr int max_image_side = 1 << 17;

struct ChannelInfo {
  std::string name;
  Imf::PixelType type = Imf::HALF;
};

// Standard camera attributes; absent, of another type, zero, negative or NaN: unset.
struct CameraAttributes {
  std::optional<float> focus_distance_m;
  std::optional<float> fstop;
  std::optional<float> focal_length_mm;  // pinhole, else effective, else nominal
  std::optional<float> sensor_width_mm, sensor_height_mm;
};

struct FileInfo {
  std::string path;
  Window display_window, data_window;
  float pixel_aspect = 1;
  std::vector<ChannelInfo> channels;  // in the file's order, sorted by name
  std::vector<std::string> views;     // multiView attribute; empty if there is none
  Imf::Compression compression = Imf::NO_COMPRESSION;
  bool tiled = false;
  bool complete = true;  // false: still being written, or cut short where the pixels begin
  CameraAttributes camera;
  Chromaticities chromaticities;  // Rec. 709 where the header says nothing
  Imf::Header header;

  ChannelNames channel_names() const;
  const ChannelInfo* find_channel(const std::string& name) const noexcept;  // null if there is none
};

// Reads the header alone; safe to call from several threads. Throws Error(unreadable): no such file, not
// OpenEXR, damaged, deep, more than one part, subsampled channels, or larger than max_image_pixels or
// max_image_side.
FileInfo read_header(const std::string& path);

// The same from an opened file's header.
FileInfo describe_header(const std::string& path, const Imf::Header& header, bool complete);

Window to_window(const Imath::Box2i& box) noexcept;  // inclusive to half-open
Imath::Box2i to_box(const Window& window) noexcept;  // `window` must not be empty

}  // namespace pullfocus::exr
