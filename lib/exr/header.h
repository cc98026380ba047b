// Headers of output files.
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <string>
#include <string_view>

#include "exr/file_info.h"

namespace pullfocus::exr {

// none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab, in any case. Throws Error(usage) that lists
// them.
Imf::Compression parse_compression(std::string_view name);
std::string_view compression_name(Imf::Compression compression) noexcept;

// A scanline header with every attribute of the input's except those that describe its encoding (channels,
// tiles, part name and type, preview). Compression is the input's unless given. A multi-view input's list of
// views is replaced by a string attribute `view`, since one view is written. No channels: write_exr() adds
// them. `data_window` must not be empty; see writable_window().
Imf::Header output_header(const FileInfo& input, const Window& data_window, const std::string& view,
                          std::optional<Imf::Compression> compression = std::nullopt);

// `window`, or the display window's first pixel where it is empty: an EXR cannot hold nothing.
Window writable_window(const Window& window, const Window& display_window) noexcept;

}  // namespace pullfocus::exr
