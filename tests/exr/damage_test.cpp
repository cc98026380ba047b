// Files that were cut short or changed: an error or some pixels, never a crash.
#include <OpenEXR/ImfThreading.h>

#include <random>

#include "exr/exr_files.h"
#include "exr/reader.h"

namespace pullfocus::exr {
namespace {

using test::TempFolder;
using test::TestImage;

TestImage image_of(Imf::Compression compression) {
  TestImage image({0, 0, 48, 40}, {-3, 2, 41, 37});
  image.add_rgbaz().add_noise("id", Imf::UINT).add_constant("flat", Imf::HALF, 1);
  image.header.compression() = compression;
  return image;
}

// Bytes of one file per compression, scanline and tiled.
std::vector<std::string> sample_files(const TempFolder& folder) {
  std::vector<std::string> files;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    const TestImage image = image_of(static_cast<Imf::Compression>(compression));
    test::write_scanlines(folder / "sample.exr", image);
    files.push_back(test::file_bytes(folder / "sample.exr"));
    test::write_tiles(folder / "sample.exr", image, 16, 16);
    files.push_back(test::file_bytes(folder / "sample.exr"));
  }
  return files;
}

// Reads over the whole data window; true if it could be read. Anything but an Error fails the test.
bool is_readable(const std::string& path) {
  try {
    Frame frame;
    ExtraChannels extra;
    read_frame(path, {}, {-3, 0, 48, 40}, frame, &extra);
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unreadable) << error.what();
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    return false;
  }
}

TEST(Damage, FileCutAnywhereIsAnError) {
  const TempFolder folder;
  std::mt19937 random(1);
  for (const std::string& bytes : sample_files(folder)) {
    std::vector<std::size_t> lengths = {1, 4, 8, 9, bytes.size() - 1};
    for (std::size_t length = 10; length < 600; length += 7) lengths.push_back(length);
    for (int i = 0; i < 40; ++i) lengths.push_back(random() % bytes.size());
    for (const std::size_t length : lengths) {
      test::write_bytes(folder / "cut.exr", bytes.substr(0, length));
      ASSERT_FALSE(is_readable(folder / "cut.exr")) << length << " of " << bytes.size() << " bytes";
    }
  }
}

TEST(Damage, UnfinishedFileIsIncomplete) {
  const TempFolder folder;
  test::write_scanlines(folder / "a.exr", image_of(Imf::ZIPS_COMPRESSION));
  std::string bytes = test::file_bytes(folder / "a.exr");
  const std::size_t table = bytes.find("screenWindowWidth") + 18 + 6 + 4 + 4 + 1;
  bytes.replace(table + 8, 8, 8, '\0');
  test::write_bytes(folder / "a.exr", bytes);
  EXPECT_FALSE(read_header(folder / "a.exr").complete);
  test::expect_error(ErrorCode::unreadable, {"incomplete"}, [&] {
    Frame frame;
    read_frame(folder / "a.exr", {}, {0, 0, 48, 40}, frame, nullptr);
  });
}

// Which options would be needed may change with a channel's name, so usage errors are fine here.
void read_whatever(const std::string& path) {
  try {
    FrameReader reader(path);
    const Selection selection = select_channels(reader.info().channel_names(), {});
    Frame frame;
    ExtraChannels extra;
    reader.read(selection, {-3, 0, 48, 40}, frame, &extra);
  } catch (const Error&) {
  }
}

TEST(Damage, FlippedBitsNeverCrash) {
  const TempFolder folder;
  std::mt19937 random(2);
  for (const std::string& bytes : sample_files(folder)) {
    for (int i = 0; i < 300; ++i) {
      if (i % 150 == 0) Imf::setGlobalThreadCount(i == 0 ? 0 : 4);
      std::string damaged = bytes;
      const std::size_t reach = i % 2 == 0 ? 700 : bytes.size();  // every second time in the header
      for (int flips = 1 + i % 3; flips > 0; --flips) {
        damaged[random() % reach] ^= static_cast<char>(1 << (random() % 8));
      }
      test::write_bytes(folder / "flipped.exr", damaged);
      read_whatever(folder / "flipped.exr");
    }
  }
  Imf::setGlobalThreadCount(0);
}

TEST(Damage, AttributeLargerThanTheFileIsRefused) {
  const TempFolder folder;
  test::write_scanlines(folder / "a.exr", image_of(Imf::ZIP_COMPRESSION));
  std::string bytes = test::file_bytes(folder / "a.exr");
  bytes.replace(bytes.find("chlist") + 7, 4, "\xff\xff\xff\x7f", 4);
  test::write_bytes(folder / "a.exr", bytes);
  test::expect_error(ErrorCode::unreadable, {"an attribute is larger than the file"},
                     [&] { read_header(folder / "a.exr"); });
}

}  // namespace
}  // namespace pullfocus::exr
