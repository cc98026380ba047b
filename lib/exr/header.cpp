#include "exr/header.h"

#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "exr/channel_names.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

// In the order of Imf::Compression.
constexpr std::array<std::string_view, Imf::NUM_COMPRESSION_METHODS> compression_names = {
    "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};

// They describe how the input was stored, or pixels that the output replaces. The required attributes are set
// anew.
constexpr std::array<std::string_view, 14> own_attributes = {
    "channels", "tiles",      "compression", "dataWindow",         "lineOrder", "name",           "type",
    "version",  "chunkCount", "preview",     "maxSamplesPerPixel", "multiView", "deepImageState", "view"};

}  // namespace

Imf::Compression parse_compression(std::string_view name) {
  const auto found = std::ranges::find(compression_names, lower(name));
  if (found == compression_names.end()) {
    throw Error(ErrorCode::usage,
                fmt::format("--compression '{}': not one of {}", name, fmt::join(compression_names, ", ")));
  }
  return static_cast<Imf::Compression>(found - compression_names.begin());
}

std::string_view compression_name(Imf::Compression compression) noexcept {
  const auto index = static_cast<std::size_t>(compression);
  return index < compression_names.size() ? compression_names[index] : "unknown";
}

Imf::Header output_header(const FileInfo& input, const Window& data_window, const std::string& view,
                          std::optional<Imf::Compression> compression) {
  Imf::Header header(to_box(input.display_window), to_box(data_window), input.pixel_aspect);
  for (auto attribute = input.header.begin(); attribute != input.header.end(); ++attribute) {
    if (std::ranges::find(own_attributes, attribute.name()) != own_attributes.end()) continue;
    header.insert(attribute.name(), attribute.attribute());
  }
  header.compression() = compression.value_or(input.compression);
  header.lineOrder() = Imf::INCREASING_Y;
  if (!view.empty()) header.insert("view", Imf::StringAttribute(view));
  return header;
}

Window writable_window(const Window& window, const Window& display_window) noexcept {
  if (!window.empty()) return window;
  return {display_window.x0, display_window.y0, display_window.x0 + 1, display_window.y0 + 1};
}

}  // namespace pullfocus::exr
