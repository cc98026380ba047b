#include "exr/deep_writer.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfPartType.h>

#include <cstddef>

#include "exr/temp_file.h"

namespace pullfocus::exr {
namespace {

// Addresses of each pixel's first sample, in the form the library wants.
template <class Sample>
std::vector<char*> pixel_pointers(const std::vector<unsigned int>& counts, const std::vector<Sample>& samples) {
  std::vector<char*> pointers;
  pointers.reserve(counts.size());
  std::size_t next = 0;
  for (const unsigned int count : counts) {
    pointers.push_back(const_cast<char*>(reinterpret_cast<const char*>(samples.data() + next)));
    next += count;
  }
  return pointers;
}

void write_samples(Imf::OStream& stream, Imf::Header header, const DeepSamples& samples) {
  const Imath::Box2i box = header.dataWindow();
  const int width = box.max.x - box.min.x + 1, height = box.max.y - box.min.y + 1;
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels() = Imf::ChannelList();

  Imf::DeepFrameBuffer buffer;
  const auto count_stride = sizeof(unsigned int);
  const std::ptrdiff_t first = box.min.x + static_cast<std::ptrdiff_t>(box.min.y) * width;
  buffer.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, const_cast<char*>(reinterpret_cast<const char*>(samples.counts.data() - first)),
                 count_stride, count_stride * static_cast<std::size_t>(width)));
  std::vector<std::vector<char*>> pointers;
  pointers.reserve(6);
  const auto add = [&](const char* name, Imf::PixelType type, std::size_t bytes, std::vector<char*> list) {
    pointers.push_back(std::move(list));
    header.channels().insert(name, Imf::Channel(type));
    buffer.insert(name, Imf::DeepSlice(type, reinterpret_cast<char*>(pointers.back().data() - first), sizeof(char*),
                                       sizeof(char*) * static_cast<std::size_t>(width), bytes));
  };
  add("R", Imf::HALF, sizeof(half), pixel_pointers(samples.counts, samples.r));
  add("G", Imf::HALF, sizeof(half), pixel_pointers(samples.counts, samples.g));
  add("B", Imf::HALF, sizeof(half), pixel_pointers(samples.counts, samples.b));
  add("A", Imf::HALF, sizeof(half), pixel_pointers(samples.counts, samples.a));
  add("Z", Imf::FLOAT, sizeof(float), pixel_pointers(samples.counts, samples.z));
  add("ZBack", Imf::FLOAT, sizeof(float), pixel_pointers(samples.counts, samples.z_back));

  Imf::DeepScanLineOutputFile file(stream, header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
}

}  // namespace

void write_deep_exr(const std::string& path, const Imf::Header& header, const DeepSamples& samples) {
  write_whole(path, [&](Imf::OStream& stream) { write_samples(stream, header, samples); });
}

}  // namespace pullfocus::exr
