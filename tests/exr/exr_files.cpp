#include "exr/exr_files.h"

#include <Imath/half.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <stdlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "exr/file_info.h"

namespace pullfocus::exr::test {
namespace {

std::size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

// Exponents below all ones: neither NaN nor infinity, which lossless codecs keep but comparisons of values do
// not.
std::uint32_t noise_bits(Imf::PixelType type, std::mt19937& random) {
  const auto bits = static_cast<std::uint32_t>(random());
  if (type == Imf::HALF) return bits & 0xbfffu;
  return type == Imf::FLOAT ? bits & 0xbfffffffu : bits;
}

Imf::FrameBuffer frame_buffer(TestImage& image) {
  Imf::FrameBuffer buffer;
  for (auto& [name, channel] : image.channels) {
    buffer.insert(name, Imf::Slice::Make(channel.type, channel.samples.data(), to_box(image.data)));
  }
  return buffer;
}

}  // namespace

TempFolder::TempFolder() {
  std::string name = testing::TempDir() + "pullfocus_exr_XXXXXX";
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TempFolder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TestImage::TestImage(const Window& display_window, const Window& data_window)
    : display(display_window), data(data_window), header(to_box(display_window), to_box(data_window)) {
  header.compression() = Imf::ZIP_COMPRESSION;
}

void TestImage::add(const std::string& name, TestChannel channel) {
  header.channels().insert(name, Imf::Channel(channel.type));
  channels[name] = std::move(channel);
}

TestImage& TestImage::add_noise(const std::string& name, Imf::PixelType type) {
  std::mt19937 random(static_cast<unsigned>(std::hash<std::string>{}(name)));
  TestChannel channel{type, std::vector<std::byte>(data.pixels() * bytes_of(type))};
  for (std::size_t at = 0; at < channel.samples.size(); at += bytes_of(type)) {
    const std::uint32_t bits = noise_bits(type, random);
    std::memcpy(channel.samples.data() + at, &bits, bytes_of(type));
  }
  add(name, std::move(channel));
  return *this;
}

TestImage& TestImage::add_constant(const std::string& name, Imf::PixelType type, float value) {
  const half as_half(value);
  const auto as_uint = type == Imf::UINT ? static_cast<std::uint32_t>(value) : 0u;
  const void* sample = type == Imf::HALF ? static_cast<const void*>(&as_half) : &value;
  if (type == Imf::UINT) sample = &as_uint;
  TestChannel channel{type, std::vector<std::byte>(data.pixels() * bytes_of(type))};
  for (std::size_t at = 0; at < channel.samples.size(); at += bytes_of(type)) {
    std::memcpy(channel.samples.data() + at, sample, bytes_of(type));
  }
  add(name, std::move(channel));
  return *this;
}

TestImage& TestImage::add_rgbaz(const std::string& prefix) {
  for (const char* name : {"R", "G", "B", "A"}) add_noise(prefix + name, Imf::HALF);
  return add_noise(prefix + "Z", Imf::FLOAT);
}

float TestImage::value(const std::string& name, int x, int y) const {
  const TestChannel& channel = channels.at(name);
  const auto index = static_cast<std::size_t>(y - data.y0) * static_cast<std::size_t>(data.width()) +
                     static_cast<std::size_t>(x - data.x0);
  const std::byte* sample = channel.samples.data() + index * bytes_of(channel.type);
  std::uint32_t bits = 0;
  std::memcpy(&bits, sample, bytes_of(channel.type));
  if (channel.type == Imf::UINT) return static_cast<float>(bits);
  if (channel.type == Imf::HALF) return imath_half_to_float(static_cast<std::uint16_t>(bits));
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void write_scanlines(const std::string& path, const TestImage& image) {
  TestImage copy = image;
  Imf::OutputFile file(path.c_str(), copy.header);
  file.setFrameBuffer(frame_buffer(copy));
  file.writePixels(copy.data.height());
}

void write_tiles(const std::string& path, const TestImage& image, unsigned tile_width, unsigned tile_height,
                 bool mipmap) {
  TestImage copy = image;
  copy.header.setTileDescription(
      Imf::TileDescription(tile_width, tile_height, mipmap ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
  Imf::TiledOutputFile file(path.c_str(), copy.header);
  file.setFrameBuffer(frame_buffer(copy));
  for (int level = 0; level < file.numLevels(); ++level) {
    file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  }
}

void write_deep(const std::string& path) {
  Imf::Header header(4, 1);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  std::vector<unsigned> counts(4, 1);
  std::vector<float> depths = {1, 2, 3, 4};
  std::vector<float*> pixels;
  for (float& depth : depths) pixels.push_back(&depth);
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(unsigned), 4 * sizeof(unsigned)));
  buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), sizeof(float*),
                                    4 * sizeof(float*), sizeof(float)));
  Imf::DeepScanLineOutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(1);
}

void write_two_parts(const std::string& path) {
  TestImage image({0, 0, 4, 4}, {0, 0, 4, 4});
  image.add_rgbaz();
  std::vector<Imf::Header> headers(2, image.header);
  for (std::size_t i = 0; i < headers.size(); ++i) {
    headers[i].setType(Imf::SCANLINEIMAGE);
    headers[i].setName("part" + std::to_string(i));
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
  for (int i = 0; i < 2; ++i) {
    Imf::OutputPart part(file, i);
    part.setFrameBuffer(frame_buffer(image));
    part.writePixels(4);
  }
}

TestImage read_back(const std::string& path) {
  Imf::InputFile file(path.c_str());
  TestImage image(to_window(file.header().displayWindow()), to_window(file.header().dataWindow()));
  image.header = file.header();
  for (auto channel = file.header().channels().begin(); channel != file.header().channels().end(); ++channel) {
    const Imf::PixelType type = channel.channel().type;
    image.channels[channel.name()] = {type, std::vector<std::byte>(image.data.pixels() * bytes_of(type))};
  }
  file.setFrameBuffer(frame_buffer(image));
  file.readPixels(image.data.y0, image.data.y1 - 1);
  return image;
}

std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace pullfocus::exr::test
