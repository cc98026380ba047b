#include "exr/reader.h"

#include <Imath/half.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "exr/file_check.h"
#include "exr/pixels.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::unreadable, fmt::format("{}: {}", path, reason));
}

const ChannelInfo& require_channel(const FileInfo& info, const std::string& name) {
  const ChannelInfo* channel = info.find_channel(name);
  if (!channel) fail(info.path, fmt::format("has no channel {}, which was selected for this sequence", name));
  return *channel;
}

SampleType colour_type(const FileInfo& info, const Selection& selection) {
  const bool half = std::ranges::all_of(selection.colour, [&](const NamedChannel& channel) {
    return require_channel(info, channel.file_name).type == Imf::HALF;
  });
  return half ? SampleType::half : SampleType::float32;
}

void fill_alpha_with_one(ColourImage& colour) {
  const Window& window = colour.window();
  for (int y = window.y0; y < window.y1; ++y) {
    std::byte* pixel = colour.pixel(window.x0, y);
    for (int x = window.x0; x < window.x1; ++x, pixel += colour.pixel_bytes()) {
      if (colour.type() == SampleType::half) {
        const std::uint16_t one = 0x3c00;
        std::memcpy(pixel + 6, &one, sizeof one);
      } else {
        const float one = 1;
        std::memcpy(pixel + 12, &one, sizeof one);
      }
    }
  }
}

void add_colour_targets(const Selection& selection, const Window& common, ColourImage& colour,
                        std::vector<ChannelTarget>& targets) {
  const bool half = colour.type() == SampleType::half;
  std::byte* sample = colour.pixel(common.x0, common.y0);
  for (const NamedChannel& channel : selection.colour) {
    targets.push_back(
        {channel.file_name, half ? Imf::HALF : Imf::FLOAT, sample, colour.pixel_bytes(), colour.row_bytes()});
    sample += sample_bytes(colour.type());
  }
}

void add_extra_targets(const FileInfo& info, const Selection& selection, const Window& common, ExtraChannels& extra,
                       std::vector<ChannelTarget>& targets) {
  extra.reset(common, selection.extra.size());
  for (std::size_t i = 0; i < selection.extra.size(); ++i) {
    const NamedChannel& name = selection.extra[i];
    ExtraChannel& channel = extra.channels[i];
    channel.name = name.output_name;
    channel.type = require_channel(info, name.file_name).type;
    const std::size_t bytes = sample_bytes(channel.type);
    channel.samples.resize(common.pixels() * bytes);
    targets.push_back({name.file_name, channel.type, channel.samples.data(), bytes,
                       bytes * static_cast<std::size_t>(common.width())});
  }
}

void add_depth_target(const Selection& selection, const Window& common, Plane& depth,
                      std::vector<ChannelTarget>& targets) {
  targets.push_back({selection.depth, Imf::FLOAT, reinterpret_cast<std::byte*>(&depth.at(common.x0, common.y0)),
                     sizeof(float), sizeof(float) * static_cast<std::size_t>(depth.window().width())});
}

template <typename Stored, typename Convert>
void convert_plane(const std::byte* samples, const Window& common, Plane& depth, Convert convert) {
  for (int y = common.y0; y < common.y1; ++y) {
    float* values = &depth.at(common.x0, y);
    for (int x = 0; x < common.width(); ++x, samples += sizeof(Stored)) {
      Stored stored;
      std::memcpy(&stored, samples, sizeof stored);
      values[x] = convert(stored);
    }
  }
}

// A frame buffer takes a channel once; where depth is also carried along as it is stored, it is converted
// from there.
void convert_depth(const ExtraChannel& stored, const Window& common, Plane& depth) {
  const std::byte* samples = stored.samples.data();
  if (stored.type == Imf::HALF) {
    convert_plane<std::uint16_t>(samples, common, depth, imath_half_to_float);
  } else if (stored.type == Imf::UINT) {
    convert_plane<std::uint32_t>(samples, common, depth, [](auto value) { return static_cast<float>(value); });
  } else {
    convert_plane<float>(samples, common, depth, [](float value) { return value; });
  }
}

}  // namespace

FrameReader::FrameReader(const std::string& path) {
  check_file(path);
  try {
    file_ = std::make_unique<Imf::MultiPartInputFile>(path.c_str(), Imf::globalThreadCount(), false);
    info_ = describe_header(path, file_->header(0), file_->partComplete(0));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    fail(path, fmt::format("cannot be read: {}", plain_reason(error.what(), path)));
  }
}

FrameReader::~FrameReader() = default;

std::size_t FrameReader::read(const Selection& selection, const Window& state_window, Frame& frame,
                              ExtraChannels* extra) {
  if (!info_.complete) fail(info_.path, "is incomplete: it is still being written, or was cut short");
  const bool with_depth = !selection.depth.empty();
  if (with_depth) require_channel(info_, selection.depth);
  frame.colour.reset(state_window, colour_type(info_, selection));
  frame.depth.reset(state_window, std::numeric_limits<float>::infinity());
  frame.has_alpha = selection.has_alpha();
  if (!frame.has_alpha) fill_alpha_with_one(frame.colour);

  Window common = intersect(info_.data_window, state_window);
  if (common.empty()) common = Window{};
  std::vector<ChannelTarget> targets;
  if (extra) add_extra_targets(info_, selection, common, *extra, targets);
  if (common.empty()) return info_.data_window.pixels();
  add_colour_targets(selection, common, frame.colour, targets);
  const auto kept_depth = std::ranges::find(selection.extra, selection.depth, &NamedChannel::file_name);
  const bool converts = extra && kept_depth != selection.extra.end();
  if (with_depth && !converts) add_depth_target(selection, common, frame.depth, targets);
  try {
    read_pixels(*file_, targets, info_.data_window, common);
  } catch (const std::exception& error) {
    fail(info_.path, fmt::format("its pixels cannot be read: {}", plain_reason(error.what(), info_.path)));
  }
  if (converts) {
    const auto index = static_cast<std::size_t>(kept_depth - selection.extra.begin());
    convert_depth(extra->channels[index], common, frame.depth);
  }
  return info_.data_window.pixels() - common.pixels();
}

std::size_t read_frame(const std::string& path, const ChannelOptions& options, const Window& state_window, Frame& frame,
                       ExtraChannels* extra) {
  FrameReader reader(path);
  return reader.read(select_channels(reader.info().channel_names(), options), state_window, frame, extra);
}

}  // namespace pullfocus::exr
