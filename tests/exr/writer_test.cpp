#include "exr/writer.h"

#include <OpenEXR/ImfStringAttribute.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "exr/exr_files.h"
#include "exr/header.h"
#include "exr/reader.h"

namespace pullfocus::exr {
namespace {

using test::expect_error;
using test::TempFolder;
using test::TestImage;

std::vector<OutputChannel> planar_channels(const TestImage& image) {
  std::vector<OutputChannel> channels;
  for (const auto& [name, channel] : image.channels) {
    const std::size_t bytes = sample_bytes(channel.type);
    channels.push_back(
        {name, channel.type, channel.samples.data(), bytes, bytes * static_cast<std::size_t>(image.data.width())});
  }
  return channels;
}

TestImage noisy_image(const Window& data) {
  TestImage image({0, 0, 64, 64}, data);
  image.add_rgbaz().add_noise("id", Imf::UINT).add_noise("n.x", Imf::HALF);
  return image;
}

// Files larger than `bytes` fail to grow, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limit = old_;
    limit.rlim_cur = bytes;
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int) = nullptr;
};

TEST(Writer, EveryChannelComesBackBitForBit) {
  TempFolder folder;
  for (const Window& data : {Window{0, 0, 1, 1}, Window{-7, -9, 30, 40}, Window{100, 200, 163, 203}}) {
    for (const char* compression : {"none", "rle", "zips", "zip", "piz"}) {
      TestImage image = noisy_image(data);
      image.header.compression() = parse_compression(compression);
      write_exr(folder / "a.exr", image.header, planar_channels(image));
      const TestImage back = test::read_back(folder / "a.exr");
      EXPECT_EQ(back.data, image.data);
      EXPECT_EQ(back.display, image.display);
      EXPECT_EQ(back.channels, image.channels) << compression;
    }
  }
  EXPECT_EQ(folder.files(), std::vector<std::string>{"a.exr"});
}

TEST(Writer, WhatWasReadIsWrittenBitForBit) {
  TempFolder folder;
  TestImage image({0, 0, 40, 30}, {-5, 4, 50, 29});
  image.add_rgbaz().add_noise("id", Imf::UINT).add_noise("left.R", Imf::HALF).add_noise("p", Imf::FLOAT);
  image.header.insert("owner", Imf::StringAttribute("someone"));
  test::write_tiles(folder / "in.exr", image, 16, 16);

  FrameReader reader(folder / "in.exr");
  const Selection selection = select_channels(reader.info().channel_names(), {});
  Frame frame;
  ExtraChannels extra;
  reader.read(selection, unite(image.display, image.data), frame, &extra);
  std::vector<OutputChannel> channels = colour_channels(frame.colour, selection, image.data);
  std::ranges::copy(extra_channels(extra), std::back_inserter(channels));
  write_exr(folder / "out.exr", output_header(reader.info(), image.data, selection.view), channels);

  const TestImage back = test::read_back(folder / "out.exr");
  EXPECT_EQ(back.channels, image.channels);
  EXPECT_EQ(back.data, image.data);
  EXPECT_EQ(back.header.typedAttribute<Imf::StringAttribute>("owner").value(), "someone");
}

TEST(Writer, PartOfAnInterleavedImageIsWritten) {
  TempFolder folder;
  ColourImage colour({-2, -2, 6, 6}, SampleType::half);
  for (int y = -2; y < 6; ++y) {
    for (int x = -2; x < 6; ++x) {
      for (int c = 0; c < 4; ++c) colour.set(x, y, c, static_cast<float>(100 * c + 10 * y + x));
    }
  }
  const Window data = {1, 2, 4, 5};
  TestImage image({0, 0, 4, 4}, data);
  const Selection selection{
      .layer = {}, .view = {}, .colour = {{"v.R", "R"}, {"v.G", "G"}, {"v.B", "B"}}, .depth = {}, .extra = {}};
  write_exr(folder / "a.exr", image.header, colour_channels(colour, selection, data));
  const TestImage back = test::read_back(folder / "a.exr");
  ASSERT_EQ(back.channels.size(), 3u);
  EXPECT_EQ(back.value("R", 1, 2), 21);
  EXPECT_EQ(back.value("B", 3, 4), 243);
}

TEST(Writer, LossyCompressionWritesReadableFiles) {
  TempFolder folder;
  for (const char* compression : {"pxr24", "b44", "b44a", "dwaa", "dwab"}) {
    TestImage image({0, 0, 50, 50}, {0, 0, 50, 50});
    image.add_constant("R", Imf::HALF, 0.25f).add_constant("Z", Imf::FLOAT, 3);
    image.header.compression() = parse_compression(compression);
    write_exr(folder / "a.exr", image.header, planar_channels(image));
    EXPECT_NEAR(test::read_back(folder / "a.exr").value("R", 30, 30), 0.25f, 0.01f) << compression;
  }
}

TEST(Writer, OlderFileIsReplaced) {
  TempFolder folder;
  test::write_bytes(folder / "a.exr", "older");
  const TestImage image = noisy_image({0, 0, 9, 9});
  write_exr(folder / "a.exr", image.header, planar_channels(image));
  EXPECT_EQ(test::read_back(folder / "a.exr").channels, image.channels);
}

TEST(Writer, FullDiskLeavesTheOlderFileAndNothingElse) {
  TempFolder folder;
  test::write_bytes(folder / "a.exr", "older");
  const TestImage image = noisy_image({0, 0, 64, 64});
  // Failing in the header, in the pixels, and only when the last buffer is flushed.
  const std::size_t whole = [&] {
    write_exr(folder / "size.exr", image.header, planar_channels(image));
    const std::size_t bytes = std::filesystem::file_size(folder / "size.exr");
    std::filesystem::remove(folder / "size.exr");
    return bytes;
  }();
  for (const std::size_t limit : {std::size_t{0}, std::size_t{100}, whole / 2, whole - 1}) {
    {
      const FileSizeLimit full(limit);
      expect_error(ErrorCode::unwritable, {folder / "a.exr", "File too large"},
                   [&] { write_exr(folder / "a.exr", image.header, planar_channels(image)); });
    }
    EXPECT_EQ(test::file_bytes(folder / "a.exr"), "older");
    EXPECT_EQ(folder.files(), std::vector<std::string>{"a.exr"});
  }
}

TEST(Writer, ImpossiblePathsAreNamedWithTheReason) {
  TempFolder folder;
  test::write_bytes(folder / "file", "x");
  std::filesystem::create_directory(folder / "folder.exr");
  const TestImage image = noisy_image({0, 0, 9, 9});
  const auto expect = [&](const std::string& path, const std::string& reason) {
    expect_error(ErrorCode::unwritable, {path, reason}, [&] { write_exr(path, image.header, planar_channels(image)); });
  };
  expect(folder / "none/a.exr", "No such file or directory");
  expect(folder / "file/a.exr", "Not a directory");
  expect(folder / "folder.exr", "not a regular file");
  expect("/dev/full", "not a regular file");
  expect("/proc/a.exr", "");
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"file", "folder.exr"}));
}

TEST(Writer, HeaderThatOpenExrRefusesLeavesNothing) {
  TempFolder folder;
  TestImage image = noisy_image({0, 0, 9, 9});
  image.header.pixelAspectRatio() = -1;
  expect_error(ErrorCode::unwritable, {folder / "a.exr"},
               [&] { write_exr(folder / "a.exr", image.header, planar_channels(image)); });
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace pullfocus::exr
