#include "exr/header.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOpaqueAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPreviewImage.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <cmath>
#include <filesystem>

#include "exr/exr_files.h"
#include "exr/file_info.h"

namespace pullfocus::exr {
namespace {

using test::expect_error;
using test::TempFolder;
using test::TestImage;

TestImage small_image() {
  TestImage image({0, 0, 8, 6}, {-2, 1, 5, 7});
  image.add_rgbaz();
  return image;
}

FileInfo written(const TestImage& image) {
  TempFolder folder;
  test::write_scanlines(folder / "a.exr", image);
  return read_header(folder / "a.exr");
}

TEST(ReadHeader, WindowsAreHalfOpen) {
  TestImage image = small_image();
  image.header.pixelAspectRatio() = 2;
  const FileInfo info = written(image);
  EXPECT_EQ(info.display_window, image.display);
  EXPECT_EQ(info.data_window, image.data);
  EXPECT_EQ(info.pixel_aspect, 2);
  EXPECT_TRUE(info.complete);
  EXPECT_FALSE(info.tiled);
  EXPECT_TRUE(info.views.empty());
  EXPECT_EQ(info.compression, Imf::ZIP_COMPRESSION);
}

TEST(ReadHeader, ChannelsHaveTheirTypes) {
  TestImage image = small_image();
  image.add_noise("id", Imf::UINT);
  const FileInfo info = written(image);
  ASSERT_EQ(info.channels.size(), 6u);
  EXPECT_EQ(info.find_channel("R")->type, Imf::HALF);
  EXPECT_EQ(info.find_channel("Z")->type, Imf::FLOAT);
  EXPECT_EQ(info.find_channel("id")->type, Imf::UINT);
  EXPECT_EQ(info.find_channel("r"), nullptr);
}

TEST(ReadHeader, CameraAttributesAreFound) {
  TestImage image = small_image();
  Imf::addFocus(image.header, 2.5f);
  Imf::addAperture(image.header, 2.8f);
  image.header.insert("nominalFocalLength", Imf::FloatAttribute(50));
  image.header.insert("effectiveFocalLength", Imf::FloatAttribute(51));
  image.header.insert("sensorOverallDimensions", Imf::V2fAttribute({36, 24}));
  EXPECT_EQ(written(image).camera.focal_length_mm, 51.f);
  image.header.insert("pinholeFocalLength", Imf::FloatAttribute(52));
  const CameraAttributes camera = written(image).camera;
  EXPECT_EQ(camera.focal_length_mm, 52.f);
  EXPECT_EQ(camera.focus_distance_m, 2.5f);
  EXPECT_EQ(camera.fstop, 2.8f);
  EXPECT_EQ(camera.sensor_width_mm, 36.f);
  EXPECT_EQ(camera.sensor_height_mm, 24.f);
}

TEST(ReadHeader, UselessCameraAttributesAreUnset) {
  TestImage image = small_image();
  Imf::addFocus(image.header, 0);
  image.header.insert("aperture", Imf::StringAttribute("f/2"));
  image.header.insert("nominalFocalLength", Imf::FloatAttribute(-50));
  image.header.insert("sensorOverallDimensions", Imf::V2fAttribute({NAN, 24}));
  const CameraAttributes camera = written(image).camera;
  EXPECT_FALSE(camera.focus_distance_m);
  EXPECT_FALSE(camera.fstop);
  EXPECT_FALSE(camera.focal_length_mm);
  EXPECT_FALSE(camera.sensor_width_mm);
}

TEST(ReadHeader, WhatIsNoFlatExrIsSaidSo) {
  TempFolder folder;
  test::write_bytes(folder / "empty.exr", "");
  test::write_bytes(folder / "text.exr", "this is not an image, but it is longer than a magic number");
  test::write_bytes(folder / "short.exr", "\x76\x2f");
  test::write_deep(folder / "deep.exr");
  test::write_two_parts(folder / "parts.exr");
  std::filesystem::create_directory(folder / "folder.exr");
  const auto expect = [&](const std::string& name, const std::string& reason) {
    SCOPED_TRACE(name);
    expect_error(ErrorCode::unreadable, {folder / name, reason}, [&] { read_header(folder / name); });
  };
  expect("missing.exr", "no such file");
  expect("empty.exr", "empty (0 bytes)");
  expect("text.exr", "not an OpenEXR file");
  expect("short.exr", "not an OpenEXR file");
  expect("folder.exr", "is a folder");
  expect("text.exr/a.exr", "no such file");
  expect("deep.exr", "deep");
  expect("parts.exr", "2 parts");
  expect_error(ErrorCode::unreadable, {"/dev/null", "not a regular file"}, [] { read_header("/dev/null"); });
}

TEST(ReadHeader, SubsampledChannelIsNamed) {
  TempFolder folder;
  TestImage image({0, 0, 8, 6}, {0, 0, 8, 6});
  image.add_constant("Y", Imf::HALF, 1).add_constant("RY", Imf::HALF, 1);
  image.header.channels()["RY"].xSampling = image.header.channels()["RY"].ySampling = 2;
  {
    const std::string path = folder / "a.exr";
    Imf::OutputFile file(path.c_str(), image.header);
  }
  expect_error(ErrorCode::unreadable, {"channel RY", "2x2"}, [&] { read_header(folder / "a.exr"); });
}

TEST(ReadHeader, AbsurdSizesAreRefused) {
  TempFolder folder;
  TestImage image = small_image();
  image.header.displayWindow() = {{0, 0}, {1 << 20, 1 << 20}};
  test::write_scanlines(folder / "display.exr", image);
  expect_error(ErrorCode::unreadable, {"1048577 x 1048577"}, [&] { read_header(folder / "display.exr"); });

  // One zero-sized pixel row would need its chunk table: patch the stored data window instead.
  test::write_scanlines(folder / "data.exr", small_image());
  std::string bytes = test::file_bytes(folder / "data.exr");
  const std::size_t window = bytes.find("dataWindow") + 11 + 6 + 4;
  const int huge[4] = {0, 0, (1 << 30) - 2, 5};
  bytes.replace(window, sizeof huge, reinterpret_cast<const char*>(huge), sizeof huge);
  test::write_bytes(folder / "data.exr", bytes);
  expect_error(ErrorCode::unreadable, {folder / "data.exr"}, [&] { read_header(folder / "data.exr"); });
}

TEST(OutputHeader, AttributesAreCarriedOver) {
  TestImage image = small_image();
  image.header.insert("owner", Imf::StringAttribute("someone"));
  image.header.insert("aVeryLongAttributeNameWithMoreThanThirtyOneCharacters", Imf::IntAttribute(7));
  image.header.insert("custom", Imf::OpaqueAttribute("myType"));
  Imf::addTimeCode(image.header, Imf::TimeCode(1, 2, 3, 4));
  image.header.screenWindowCenter() = {0.25f, 0.5f};
  image.header.screenWindowWidth() = 3;
  const Window data = {0, 0, 3, 3};
  const Imf::Header header = output_header(written(image), data, "");

  EXPECT_EQ(to_window(header.displayWindow()), image.display);
  EXPECT_EQ(to_window(header.dataWindow()), data);
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("owner").value(), "someone");
  EXPECT_TRUE(header.find("aVeryLongAttributeNameWithMoreThanThirtyOneCharacters") != header.end());
  EXPECT_TRUE(header.find("custom") != header.end());
  EXPECT_EQ(Imf::timeCode(header).frame(), 4);
  EXPECT_EQ(header.screenWindowCenter(), Imath::V2f(0.25f, 0.5f));
  EXPECT_EQ(header.screenWindowWidth(), 3);
  EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
  EXPECT_EQ(header.channels().begin(), header.channels().end());
}

TEST(OutputHeader, EncodingOfTheInputIsLeftBehind) {
  TempFolder folder;
  TestImage image = small_image();
  image.header.setPreviewImage(Imf::PreviewImage(2, 2));
  image.header.lineOrder() = Imf::RANDOM_Y;
  image.header.setName("part");
  test::write_tiles(folder / "a.exr", image, 4, 4);
  const Imf::Header header = output_header(read_header(folder / "a.exr"), image.data, "", Imf::PIZ_COMPRESSION);
  EXPECT_FALSE(header.hasTileDescription());
  EXPECT_FALSE(header.hasType());
  EXPECT_FALSE(header.hasName());
  EXPECT_FALSE(header.hasPreviewImage());
  EXPECT_EQ(header.lineOrder(), Imf::INCREASING_Y);
  EXPECT_EQ(header.compression(), Imf::PIZ_COMPRESSION);
}

TEST(OutputHeader, ListOfViewsBecomesOneView) {
  TestImage image = small_image();
  Imf::addMultiView(image.header, {"right", "left"});
  const FileInfo info = written(image);
  EXPECT_EQ(info.views, (std::vector<std::string>{"right", "left"}));
  const Imf::Header header = output_header(info, image.data, "left");
  EXPECT_FALSE(Imf::hasMultiView(header));
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("view").value(), "left");
}

TEST(OutputHeader, CompressionNamesAreReadBack) {
  for (int i = 0; i < Imf::NUM_COMPRESSION_METHODS; ++i) {
    const auto compression = static_cast<Imf::Compression>(i);
    EXPECT_EQ(parse_compression(compression_name(compression)), compression);
  }
  EXPECT_EQ(parse_compression("DWAA"), Imf::DWAA_COMPRESSION);
  expect_error(ErrorCode::usage, {"'lzw'", "none, rle, zips"}, [] { parse_compression("lzw"); });
}

TEST(OutputHeader, NothingIsWrittenAsOnePixel) {
  EXPECT_EQ(writable_window({3, 3, 3, 9}, {-1, 2, 8, 8}), (Window{-1, 2, 0, 3}));
  EXPECT_EQ(writable_window({3, 3, 4, 9}, {0, 0, 8, 8}), (Window{3, 3, 4, 9}));
}

}  // namespace
}  // namespace pullfocus::exr
