#include "exr/reader.h"

#include <cmath>
#include <limits>

#include "exr/frame_check.h"

namespace pullfocus::exr {
namespace {

using test::expect_frame;
using test::Read;
using test::read_scanlines;
using test::TempFolder;
using test::TestImage;

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Reader, DataWindowMayLieAnywhereToTheStateWindow) {
  const Window state = {-3, -2, 17, 12};
  const Window data_windows[] = {{-3, -2, 17, 12}, {0, 0, 5, 5},  {-8, -9, 30, 40}, {-8, 3, 2, 7},      {10, 3, 22, 7},
                                 {2, -9, 5, 1},    {2, 9, 5, 19}, {-9, -9, -2, -1}, {16, 11, 20, 20},   {20, 0, 25, 10},
                                 {0, 50, 9, 60},   {0, 0, 1, 1},  {-3, 3, 17, 300}, {-4, -300, 18, 300}};
  for (const Window& data : data_windows) {
    SCOPED_TRACE(testing::Message() << data.x0 << "," << data.y0 << " " << data.x1 << "," << data.y1);
    TestImage image(state, data);
    image.add_rgbaz();
    const Read read = read_scanlines(image, state);
    ASSERT_EQ(read.frame.window(), state);
    expect_frame(read.frame, image);
    const Window common = intersect(data, state);
    EXPECT_EQ(read.outside, data.pixels() - common.pixels());
    EXPECT_EQ(read.extra.window.pixels(), common.pixels());
    ASSERT_EQ(read.extra.channels.size(), 1u);
    EXPECT_EQ(read.extra.channels[0].name, "Z");
  }
}

TEST(Reader, WithAndWithoutExtraChannelsTheFrameIsTheSame) {
  TempFolder folder;
  TestImage image({0, 0, 9, 7}, {-2, -2, 8, 9});
  image.add_rgbaz().add_noise("id", Imf::UINT);
  test::write_scanlines(folder / "a.exr", image);
  Frame with, without;
  ExtraChannels extra;
  read_frame(folder / "a.exr", {}, image.display, with, &extra);
  read_frame(folder / "a.exr", {}, image.display, without, nullptr);
  EXPECT_EQ(with.colour, without.colour);
  expect_frame(without, image);
}

TEST(Reader, OddSizesAndOriginsAreRead) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 37}, {37, 1}, {3, 5}, {257, 3}, {15, 259}}) {
    for (const int origin : {0, -1000, 7}) {
      const Window window = {origin, -origin, origin + width, -origin + height};
      TestImage image(window, window);
      image.add_rgbaz();
      expect_frame(read_scanlines(image, window).frame, image);
    }
  }
}

TEST(Reader, EveryLosslessCompressionGivesTheSamePixels) {
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    TestImage image({0, 0, 61, 77}, {-5, 3, 50, 80});
    image.add_rgbaz();
    image.header.compression() = compression;
    expect_frame(read_scanlines(image, image.display).frame, image);
    image.header.lineOrder() = Imf::DECREASING_Y;
    expect_frame(read_scanlines(image, image.display).frame, image);
  }
}

TEST(Reader, LossyCompressionIsReadToo) {
  for (const Imf::Compression compression : {Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION,
                                             Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    TestImage image({0, 0, 40, 40}, {0, 0, 40, 40});
    for (const char* name : {"R", "G", "B", "A"}) image.add_constant(name, Imf::HALF, 0.5f);
    image.add_constant("Z", Imf::FLOAT, 8);
    image.header.compression() = compression;
    const Read read = read_scanlines(image, image.display);
    EXPECT_NEAR(read.frame.colour.get(20, 20, 1), 0.5f, 0.01f);
    EXPECT_NEAR(read.frame.depth.at(39, 39), 8, 0.01f);
  }
}

TEST(Reader, TiledFilesAreReadLikeScanlines) {
  TempFolder folder;
  for (const Window& data : {Window{0, 0, 61, 45}, Window{-7, -9, 70, 33}, Window{5, 5, 6, 6}}) {
    for (const bool mipmap : {false, true}) {
      TestImage image({0, 0, 61, 45}, data);
      image.add_rgbaz();
      test::write_tiles(folder / "a.exr", image, 16, 8, mipmap);
      Frame frame;
      ExtraChannels extra;
      read_frame(folder / "a.exr", {}, image.display, frame, &extra);
      expect_frame(frame, image);
    }
  }
}

TEST(Reader, ColourIsHalfOnlyIfAllItsChannelsAre) {
  const Window window = {0, 0, 5, 5};
  TestImage image(window, window);
  image.add_rgbaz();
  EXPECT_EQ(read_scanlines(image, window).frame.colour.type(), SampleType::half);
  for (const char* name : {"A", "G"}) {
    TestImage mixed = image;
    mixed.add_noise(name, Imf::FLOAT);
    const Read read = read_scanlines(mixed, window);
    EXPECT_EQ(read.frame.colour.type(), SampleType::float32);
    expect_frame(read.frame, mixed);
  }
  image.add_constant("R", Imf::UINT, 7);
  EXPECT_EQ(read_scanlines(image, window).frame.colour.get(2, 2, 0), 7);
}

TEST(Reader, WithoutAlphaItIsOneEverywhere) {
  for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
    TestImage image({0, 0, 9, 9}, {2, 2, 5, 5});
    for (const char* name : {"R", "G", "B"}) image.add_noise(name, type);
    image.add_noise("Z", Imf::HALF);
    const Read read = read_scanlines(image, {-1, -1, 10, 10});
    EXPECT_FALSE(read.frame.has_alpha);
    expect_frame(read.frame, image);
  }
}

TEST(Reader, DepthOfAnyTypeIsFloat) {
  for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
    TestImage image({0, 0, 9, 9}, {-3, 2, 5, 12});
    image.add_rgbaz().add_noise("Z", type);
    const Read read = read_scanlines(image, image.display);
    expect_frame(read.frame, image);
    EXPECT_EQ(read.extra.channels.at(0).type, type);
    TempFolder folder;
    test::write_scanlines(folder / "a.exr", image);
    Frame frame;
    read_frame(folder / "a.exr", {}, image.display, frame, nullptr);
    expect_frame(frame, image);
  }
}

TEST(Reader, SpecialValuesPassUntouched) {
  const Window window = {0, 0, 3, 1};
  for (const float value : {infinity, -infinity, std::nanf(""), -0.f, 65504.f}) {
    TestImage image(window, window);
    image.add_rgbaz().add_constant("G", Imf::HALF, value).add_constant("Z", Imf::FLOAT, value);
    const Frame frame = read_scanlines(image, window).frame;
    for (const float read : {frame.colour.get(1, 0, 1), frame.depth.at(1, 0)}) {
      EXPECT_TRUE(read == value || (std::isnan(read) && std::isnan(value))) << read;
      EXPECT_EQ(std::signbit(read), std::signbit(value));
    }
  }
}

}  // namespace
}  // namespace pullfocus::exr
