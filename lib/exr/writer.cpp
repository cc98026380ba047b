#include "exr/writer.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>

#include "exr/file_info.h"
#include "exr/temp_file.h"

namespace pullfocus::exr {
namespace {

void write_pixels(Imf::OStream& stream, Imf::Header header, const std::vector<OutputChannel>& channels) {
  const Imath::Box2i box = header.dataWindow();
  header.channels() = Imf::ChannelList();
  Imf::FrameBuffer buffer;
  for (const OutputChannel& channel : channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.type));
    buffer.insert(channel.name, Imf::Slice::Make(channel.type, channel.base, box, channel.x_stride, channel.y_stride));
  }
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(buffer);
  file.writePixels(box.max.y - box.min.y + 1);
}

}  // namespace

std::vector<OutputChannel> colour_channels(const ColourImage& colour, const Selection& selection,
                                           const Window& data_window) {
  const Imf::PixelType type = colour.type() == SampleType::half ? Imf::HALF : Imf::FLOAT;
  const std::byte* sample = colour.pixel(data_window.x0, data_window.y0);
  std::vector<OutputChannel> channels;
  for (const NamedChannel& name : selection.colour) {
    channels.push_back({name.output_name, type, sample, colour.pixel_bytes(), colour.row_bytes()});
    sample += sample_bytes(colour.type());
  }
  return channels;
}

std::vector<OutputChannel> extra_channels(const ExtraChannels& extra) {
  std::vector<OutputChannel> channels;
  for (const ExtraChannel& channel : extra.channels) {
    const std::size_t bytes = sample_bytes(channel.type);
    channels.push_back({channel.name, channel.type, channel.samples.data(), bytes,
                        bytes * static_cast<std::size_t>(extra.window.width())});
  }
  return channels;
}

void write_exr(const std::string& path, const Imf::Header& header, const std::vector<OutputChannel>& channels) {
  write_whole(path, [&](Imf::OStream& stream) { write_pixels(stream, header, channels); });
}

}  // namespace pullfocus::exr
