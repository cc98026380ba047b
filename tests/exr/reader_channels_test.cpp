// Which channels a frame gets, and those that are carried along.
#include <OpenEXR/ImfThreading.h>

#include <cstdint>
#include <cstring>

#include "exr/frame_check.h"

namespace pullfocus::exr {
namespace {

using test::expect_error;
using test::expect_frame;
using test::Read;
using test::read_scanlines;
using test::TempFolder;
using test::TestImage;

TEST(Reader, LayersAndViewsAreRead) {
  const Window window = {0, 0, 6, 4};
  TestImage image(window, window);
  image.add_rgbaz().add_rgbaz("left.").add_rgbaz("V.Combined.");
  expect_frame(read_scanlines(image, window).frame, image);
  expect_frame(read_scanlines(image, window, {.layer = "Combined"}).frame, image, "V.Combined.");
  expect_frame(read_scanlines(image, window, {.layer = "left"}).frame, image, "left.");
}

TEST(Reader, ExtraChannelsAreBitForBit) {
  TestImage image({0, 0, 20, 15}, {-4, -6, 30, 12});
  image.add_rgbaz().add_noise("id", Imf::UINT).add_noise("n.x", Imf::HALF).add_noise("p", Imf::FLOAT);
  const Window all = image.data;
  const Read whole = read_scanlines(image, all);
  ASSERT_EQ(whole.extra.window, all);
  ASSERT_EQ(whole.extra.channels.size(), 4u);
  for (const ExtraChannel& channel : whole.extra.channels) {
    EXPECT_EQ(channel.samples, image.channels.at(channel.name).samples) << channel.name;
    EXPECT_EQ(channel.type, image.channels.at(channel.name).type) << channel.name;
  }
  const Read cropped = read_scanlines(image, image.display);
  EXPECT_EQ(pass_through(cropped.extra, image.display).channels, pass_through(whole.extra, image.display).channels);
}

TEST(Reader, PassThroughIsZeroOutsideTheData) {
  TestImage image({0, 0, 4, 4}, {1, 1, 3, 3});
  image.add_rgbaz().add_constant("id", Imf::UINT, 5);
  const Read read = read_scanlines(image, image.display);
  const ExtraChannels passed = pass_through(read.extra, {0, 0, 3, 2});
  ASSERT_EQ(passed.channels.at(1).name, "id");
  std::uint32_t ids[6];
  ASSERT_EQ(passed.channels[1].samples.size(), sizeof ids);
  std::memcpy(ids, passed.channels[1].samples.data(), sizeof ids);
  EXPECT_EQ(std::vector<std::uint32_t>(ids, ids + 6), (std::vector<std::uint32_t>{0, 0, 0, 0, 5, 5}));
}

TEST(Reader, BuffersCanBeUsedAgain) {
  TempFolder folder;
  Frame frame;
  ExtraChannels extra;
  for (const Window& data : {Window{0, 0, 30, 30}, Window{5, 5, 6, 6}, Window{40, 40, 50, 50}, Window{-5, 0, 35, 9}}) {
    TestImage image({0, 0, 30, 30}, data);
    image.add_rgbaz().add_noise("id", Imf::UINT);
    test::write_scanlines(folder / "a.exr", image);
    read_frame(folder / "a.exr", {}, image.display, frame, &extra);
    expect_frame(frame, image);
    EXPECT_EQ(pass_through(extra, data).channels.at(1).samples.size(), data.pixels() * 4);
  }
}

TEST(Reader, ThreadsDoNotChangeThePixels) {
  TestImage image({0, 0, 60, 200}, {-5, -9, 60, 190});
  image.add_rgbaz().add_noise("id", Imf::UINT);
  const Read alone = read_scanlines(image, image.display);
  Imf::setGlobalThreadCount(4);
  const Read together = read_scanlines(image, image.display);
  Imf::setGlobalThreadCount(0);
  EXPECT_EQ(together.frame.colour, alone.frame.colour);
  EXPECT_EQ(together.extra.channels, alone.extra.channels);
}

TEST(Reader, MissingSelectedChannelIsNamed) {
  TempFolder folder;
  TestImage image({0, 0, 4, 4}, {0, 0, 4, 4});
  image.add_rgbaz();
  test::write_scanlines(folder / "a.exr", image);
  FrameReader reader(folder / "a.exr");
  const Selection good = select_channels(reader.info().channel_names(), {});
  for (const auto& spoil :
       {+[](Selection& s) { s.depth = "depth"; }, +[](Selection& s) { s.colour[1].file_name = "depth"; },
        +[](Selection& s) { s.extra[0].file_name = "depth"; }}) {
    Selection selection = good;
    spoil(selection);
    Frame frame;
    ExtraChannels extra;
    expect_error(ErrorCode::unreadable, {folder / "a.exr", "no channel depth"},
                 [&] { reader.read(selection, image.display, frame, &extra); });
  }
  expect_error(ErrorCode::unreadable, {"a.exr", "deep"}, [&] {
    test::write_deep(folder / "deep_a.exr");
    FrameReader deep(folder / "deep_a.exr");
  });
}

TEST(Reader, AMaskOfAnyTypeIsReadWhetherOrNotItIsCarriedAlongOrColourOrDepthItself) {
  TestImage image({0, 0, 12, 9}, {-2, 1, 10, 14});
  image.add_rgbaz().add_noise("id", Imf::UINT).add_noise("n.x", Imf::HALF).add_noise("p", Imf::FLOAT);
  TempFolder folder;
  test::write_scanlines(folder / "a.exr", image);
  for (const char* name : {"id", "n.x", "p", "A", "G", "Z"}) {
    for (const bool carried : {true, false}) {
      Frame frame;
      ExtraChannels extra;
      read_frame(folder / "a.exr", {.mask = name}, image.display, frame, carried ? &extra : nullptr);
      test::expect_frame(frame, image);
      ASSERT_EQ(frame.mask.window(), image.display);
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 12; ++x) {
          const float expected = image.data.contains(x, y) ? image.value(name, x, y) : 0;
          ASSERT_EQ(frame.mask.at(x, y), expected) << name << " at " << x << "," << y << (carried ? " carried" : "");
        }
      }
      read_frame(folder / "a.exr", {}, image.display, frame, nullptr);
      ASSERT_FALSE(frame.has_mask());
    }
  }
}

}  // namespace
}  // namespace pullfocus::exr
