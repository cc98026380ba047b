// The module: everything that needs OpenImageIO.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "imageio/module.h"

namespace pullfocus::imageio {

namespace {

// Duplicated from picture.cpp in doubles, as a table is not worth it: the module links nothing of the program.
float decoded(float encoded) {
  const double e = static_cast<double>(encoded);
  return static_cast<float>(e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4));
}
float encoded(float linear) {
  const double l = static_cast<double>(linear);
  return static_cast<float>(l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055);
}

// "first line" of what OpenImageIO says: errors of this project are one line.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no reason given" : text;
}

bool is_srgb(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (space == "Linear" || space == "linear") return false;
  return spec.format.basetype == OIIO::TypeDesc::UINT8 || space == "sRGB";
}

std::string read_all(const std::string& path, Picture& out) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // so that colours are decoded before they are multiplied
  const auto file = OIIO::ImageInput::open(path, &hints);
  if (!file) return one_line(OIIO::geterror());
  const OIIO::ImageSpec spec = file->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.deep) return "it has no plain pixels";
  if (static_cast<double>(spec.width) * spec.height > 2e8) return "it is too large";
  const int alpha = spec.alpha_channel >= 0                      ? spec.alpha_channel
                    : spec.nchannels == 2 || spec.nchannels == 4 ? spec.nchannels - 1
                                                                 : -1;
  const bool grey = spec.nchannels < 3;
  const int named[3] = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  const bool rgb_named = named[0] >= 0 && named[1] >= 0 && named[2] >= 0;
  std::vector<float> samples(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples.data()))
    return one_line(file->geterror());

  const bool srgb = is_srgb(spec), unassociated = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  out.width = spec.width;
  out.height = spec.height;
  out.rgba.resize(spec.image_pixels() * 4);
  for (std::size_t i = 0; i < spec.image_pixels(); ++i) {
    const float* in = &samples[i * static_cast<std::size_t>(spec.nchannels)];
    float* to = &out.rgba[i * 4];
    to[3] = alpha >= 0 ? in[alpha] : 1.f;
    for (int c = 0; c < 3; ++c) {
      const float value = in[grey ? 0 : rgb_named ? named[c] : c];
      const float linear = srgb ? decoded(value) : value;
      to[c] = unassociated && alpha >= 0 ? linear * to[3] : linear;
    }
  }
  return "";
}

std::string write_all(const std::string& path, const Picture& picture) {
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (picture.width < 1 || picture.height < 1 || picture.rgba.size() != pixels * 4) return "the picture is empty";
  const auto file = OIIO::ImageOutput::create(path);
  if (!file) return one_line(OIIO::geterror());
  bool opaque = true;
  for (std::size_t i = 0; i < pixels; ++i) opaque &= picture.rgba[i * 4 + 3] == 1.f;
  const int channels = opaque || file->supports("alpha") == 0 ? 3 : 4;
  const std::string format = file->format_name();
  const bool floats = format == "openexr" || format == "hdr" || format == "pfm";
  OIIO::ImageSpec spec(picture.width, picture.height, channels, floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", floats ? "Linear" : "sRGB");
  if (!floats) spec.attribute("oiio:UnassociatedAlpha", 1);  // as encoded below

  std::vector<float> samples;
  std::vector<std::uint8_t> bytes;
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(value > 0 ? std::min(value, 1.f) * 255 + 0.5f : 0);
  };
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* in = &picture.rgba[i * 4];
    for (int c = 0; c < channels; ++c) {
      if (floats) {
        samples.push_back(in[c]);
      } else if (c == 3) {
        bytes.push_back(byte(in[c]));
      } else {
        const float straight = channels == 4 && in[3] > 0 ? in[c] / in[3] : in[c];
        bytes.push_back(byte(straight > 0 ? encoded(straight) : 0.f));
      }
    }
  }
  if (!file->open(path, spec)) return one_line(file->geterror());
  const bool written = floats ? file->write_image(OIIO::TypeDesc::FLOAT, samples.data())
                              : file->write_image(OIIO::TypeDesc::UINT8, bytes.data());
  const bool closed = file->close();
  return written && closed ? "" : one_line(file->geterror());
}

// Nothing may leave the module as an exception: its types are the module's own.
template <typename Work>
std::string guarded(Work&& work) noexcept {
  try {
    return work();
  } catch (const std::exception& error) {
    return one_line(error.what());
  } catch (...) {
    return "unknown failure";
  }
}

std::string read(const std::string& path, Picture& out) noexcept {
  return guarded([&] { return read_all(path, out); });
}
std::string write(const std::string& path, const Picture& picture) noexcept {
  return guarded([&] { return write_all(path, picture); });
}

constexpr Module kModule{kModuleVersion, &read, &write};

}  // namespace

}  // namespace pullfocus::imageio

extern "C" const pullfocus::imageio::Module* pullfocus_imageio_module() { return &pullfocus::imageio::kModule; }
