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

void add_plane_target(const std::string& channel, const Window& common, Plane& plane,
                      std::vector<ChannelTarget>& targets) {
  targets.push_back({channel, Imf::FLOAT, reinterpret_cast<std::byte*>(&plane.at(common.x0, common.y0)), sizeof(float),
                     sizeof(float) * static_cast<std::size_t>(plane.window().width())});
}

template <typename Stored, typename Convert>
void convert_plane(const std::byte* samples, const Window& common, Plane& plane, Convert convert) {
  for (int y = common.y0; y < common.y1; ++y) {
    float* values = &plane.at(common.x0, y);
    for (int x = 0; x < common.width(); ++x, samples += sizeof(Stored)) {
      Stored stored;
      std::memcpy(&stored, samples, sizeof stored);
      values[x] = convert(stored);
    }
  }
}

void convert_stored(const ExtraChannel& stored, const Window& common, Plane& plane) {
  const std::byte* samples = stored.samples.data();
  if (stored.type == Imf::HALF) {
    convert_plane<std::uint16_t>(samples, common, plane, imath_half_to_float);
  } else if (stored.type == Imf::UINT) {
    convert_plane<std::uint32_t>(samples, common, plane, [](auto value) { return static_cast<float>(value); });
  } else {
    convert_plane<float>(samples, common, plane, [](float value) { return value; });
  }
}

// A frame buffer takes a channel once: one that is also read as colour, or carried along as it is stored, is taken from
// there afterwards.
class PlaneReader {
 public:
  PlaneReader(const std::string& channel, const Selection& selection, const ExtraChannels* extra, Plane& plane)
      : channel_(channel), selection_(selection), extra_(extra), plane_(plane) {}

  void add_target(const Window& common, std::vector<ChannelTarget>& targets) const {
    const bool is_read = std::ranges::find(targets, channel_, &ChannelTarget::channel) != targets.end();
    if (!is_read) add_plane_target(channel_, common, plane_, targets);
  }

  void take(const Window& common, const Frame& frame) const {
    const auto of_colour = std::ranges::find(selection_.colour, channel_, &NamedChannel::file_name);
    const auto of_extra = std::ranges::find(selection_.extra, channel_, &NamedChannel::file_name);
    if (of_colour != selection_.colour.end()) {
      const auto c = static_cast<int>(of_colour - selection_.colour.begin());
      for (int y = common.y0; y < common.y1; ++y) {
        for (int x = common.x0; x < common.x1; ++x) plane_.at(x, y) = frame.colour.get(x, y, c);
      }
    } else if (extra_ && of_extra != selection_.extra.end()) {
      const auto index = static_cast<std::size_t>(of_extra - selection_.extra.begin());
      convert_stored(extra_->channels[index], common, plane_);
    } else if (&plane_ != &frame.depth && channel_ == selection_.depth) {
      for (int y = common.y0; y < common.y1; ++y) {
        std::copy_n(&frame.depth.at(common.x0, y), common.width(), &plane_.at(common.x0, y));
      }
    }
  }

 private:
  const std::string& channel_;
  const Selection& selection_;
  const ExtraChannels* extra_;
  Plane& plane_;
};

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
  if (!selection.mask.empty()) require_channel(info_, selection.mask);
  frame.colour.reset(state_window, colour_type(info_, selection));
  frame.depth.reset(state_window, std::numeric_limits<float>::infinity());
  frame.mask.reset(selection.mask.empty() ? Window{} : state_window, 0);
  frame.has_alpha = selection.has_alpha();
  if (!frame.has_alpha) fill_alpha_with_one(frame.colour);

  Window common = intersect(info_.data_window, state_window);
  if (common.empty()) common = Window{};
  std::vector<ChannelTarget> targets;
  if (extra) add_extra_targets(info_, selection, common, *extra, targets);
  if (common.empty()) return info_.data_window.pixels();
  add_colour_targets(selection, common, frame.colour, targets);
  std::vector<PlaneReader> planes;
  if (with_depth) planes.emplace_back(selection.depth, selection, extra, frame.depth);
  if (!selection.mask.empty()) planes.emplace_back(selection.mask, selection, extra, frame.mask);
  for (const PlaneReader& plane : planes) plane.add_target(common, targets);
  try {
    read_pixels(*file_, targets, info_.data_window, common);
  } catch (const std::exception& error) {
    fail(info_.path, fmt::format("its pixels cannot be read: {}", plain_reason(error.what(), info_.path)));
  }
  for (const PlaneReader& plane : planes) plane.take(common, frame);
  return info_.data_window.pixels() - common.pixels();
}

std::size_t read_frame(const std::string& path, const ChannelOptions& options, const Window& state_window, Frame& frame,
                       ExtraChannels* extra) {
  FrameReader reader(path);
  return reader.read(select_channels(reader.info().channel_names(), options), state_window, frame, extra);
}

}  // namespace pullfocus::exr
