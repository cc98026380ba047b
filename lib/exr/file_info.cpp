#include "exr/file_info.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>

#include <algorithm>

#include "exr/file_check.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

constexpr unsigned max_tile_excess = 4096;  // tiles may be larger than a small image, up to this side

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::unreadable, fmt::format("{}: {}", path, reason));
}

std::optional<float> positive(float value) { return value > 0 ? std::optional(value) : std::nullopt; }

std::optional<float> number(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::FloatAttribute>(name);
  return attribute ? positive(attribute->value()) : std::nullopt;
}

Chromaticities to_chromaticities(const Imf::Chromaticities& c) {
  const auto xy = [](const Imath::V2f& v) {
    return std::array<double, 2>{static_cast<double>(v.x), static_cast<double>(v.y)};
  };
  return {xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
}

CameraAttributes read_camera(const Imf::Header& header) {
  CameraAttributes camera;
  camera.focus_distance_m = number(header, "focus");
  camera.fstop = number(header, "aperture");
  for (const char* name : {"pinholeFocalLength", "effectiveFocalLength", "nominalFocalLength"}) {
    if (!camera.focal_length_mm) camera.focal_length_mm = number(header, name);
  }
  if (const auto* size = header.findTypedAttribute<Imf::V2fAttribute>("sensorOverallDimensions")) {
    camera.sensor_width_mm = positive(size->value().x);
    camera.sensor_height_mm = positive(size->value().y);
  }
  return camera;
}

void check_size(const FileInfo& info) {
  for (const Window& window : {info.display_window, info.data_window}) {
    if (window.empty() || window.pixels() > max_image_pixels ||
        std::max(window.width(), window.height()) > max_image_side) {
      fail(info.path, fmt::format("says it is {} x {} pixels: damaged, or larger than supported", window.width(),
                                  window.height()));
    }
  }
}

void check_tiles(const FileInfo& info) {
  if (!info.tiled) return;
  const Imf::TileDescription& tile = info.header.tileDescription();
  if (tile.xSize > std::max<unsigned>(max_tile_excess, static_cast<unsigned>(info.data_window.width())) ||
      tile.ySize > std::max<unsigned>(max_tile_excess, static_cast<unsigned>(info.data_window.height()))) {
    fail(info.path, fmt::format("says its tiles are {} x {} pixels: damaged", tile.xSize, tile.ySize));
  }
}

void read_channels(FileInfo& info) {
  const Imf::ChannelList& list = info.header.channels();
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    const Imf::Channel& description = channel.channel();
    if (description.xSampling != 1 || description.ySampling != 1) {
      fail(info.path,
           fmt::format("channel {} is subsampled {}x{} (luminance-chroma?), which is not supported; convert it to RGB",
                       channel.name(), description.xSampling, description.ySampling));
    }
    info.channels.push_back({channel.name(), description.type});
  }
  if (info.channels.empty()) fail(info.path, "has no channels");
}

}  // namespace

Window to_window(const Imath::Box2i& box) noexcept { return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}; }

Imath::Box2i to_box(const Window& window) noexcept { return {{window.x0, window.y0}, {window.x1 - 1, window.y1 - 1}}; }

ChannelNames FileInfo::channel_names() const {
  ChannelNames names{path, {}, views};
  for (const ChannelInfo& channel : channels) names.channels.push_back(channel.name);
  return names;
}

const ChannelInfo* FileInfo::find_channel(const std::string& name) const noexcept {
  const auto found = std::ranges::find(channels, name, &ChannelInfo::name);
  return found == channels.end() ? nullptr : &*found;
}

FileInfo describe_header(const std::string& path, const Imf::Header& header, bool complete) {
  if (header.hasType() && !Imf::isImage(header.type())) {
    fail(path, fmt::format("is of type '{}'; only flat images are supported", header.type()));
  }
  FileInfo info;
  info.path = path;
  info.header = header;
  info.display_window = to_window(header.displayWindow());
  info.data_window = to_window(header.dataWindow());
  info.pixel_aspect = header.pixelAspectRatio();
  info.compression = header.compression();
  info.tiled = header.hasType() ? Imf::isTiled(header.type()) : header.hasTileDescription();
  info.complete = complete;
  if (Imf::hasMultiView(header)) info.views = Imf::multiView(header);
  info.camera = read_camera(header);
  if (Imf::hasChromaticities(header)) info.chromaticities = to_chromaticities(Imf::chromaticities(header));
  check_size(info);
  check_tiles(info);
  read_channels(info);
  return info;
}

FileInfo read_header(const std::string& path) {
  check_file(path);
  try {
    const Imf::MultiPartInputFile file(path.c_str(), 0, false);
    return describe_header(path, file.header(0), file.partComplete(0));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    fail(path, fmt::format("cannot be read: {}", plain_reason(error.what(), path)));
  }
}

}  // namespace pullfocus::exr
