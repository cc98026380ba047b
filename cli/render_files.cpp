#include "render_files.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>

#include "exr/deep_writer.h"
#include "exr/writer.h"

namespace pullfocus::cli {
namespace {

Imf::Header header_of(int width, int height, const Taken& taken) {
  const ThinLens& lens = taken.lens;
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  if (taken.has_lens) {
    Imf::addFocus(header, static_cast<float>(lens.focus_distance * lens.metres_per_unit));
    Imf::addAperture(header, static_cast<float>(lens.f_number));
  }
  header.insert("nominalFocalLength", Imf::FloatAttribute(static_cast<float>(lens.focal_length_mm)));
  header.insert("sensorOverallDimensions",
                Imf::V2fAttribute({static_cast<float>(lens.sensor_mm), static_cast<float>(taken.sensor_height_mm)}));
  if (!taken.comment.empty()) header.insert("comments", Imf::StringAttribute(taken.comment));
  return header;
}

std::vector<exr::OutputChannel> rgb(const ColourImage& colour) {
  exr::Selection selection;
  for (const char* name : {"R", "G", "B"}) selection.colour.push_back({name, name});
  return exr::colour_channels(colour, selection, colour.window());
}

half as_half(float value) { return half(std::min(value, 65504.0f)); }

}  // namespace

void write_picture_and_depth(const std::string& path, const Taken& taken, const Frame& frame) {
  const Window& w = frame.window();
  auto channels = rgb(frame.colour);
  channels.push_back({"Z", Imf::FLOAT, reinterpret_cast<const std::byte*>(frame.depth.row(w.y0)), sizeof(float),
                      sizeof(float) * static_cast<std::size_t>(w.width())});
  exr::write_exr(path, header_of(w.width(), w.height(), taken), channels);
}

void write_truth(const std::string& path, const Taken& taken, const ColourImage& colour) {
  exr::write_exr(path, header_of(colour.window().width(), colour.window().height(), taken), rgb(colour));
}

void write_deep(const std::string& path, const Taken& taken, const sequences::DeepPixels& pixels) {
  exr::DeepSamples samples;
  for (const auto& pixel : pixels.pixels) {
    samples.counts.push_back(static_cast<unsigned int>(pixel.size()));
    for (const auto& sample : pixel) {
      samples.z.push_back(sample.depth);
      samples.z_back.push_back(sample.depth);
      samples.r.push_back(as_half(sample.colour.r));
      samples.g.push_back(as_half(sample.colour.g));
      samples.b.push_back(as_half(sample.colour.b));
      samples.a.push_back(half(1.0f));
    }
  }
  exr::write_deep_exr(path, header_of(pixels.width, pixels.height, taken), samples);
}

}  // namespace pullfocus::cli
