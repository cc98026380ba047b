// Small valid files, changed at random: what can be read is read, everything else is one clear error.
#include <algorithm>
#include <filesystem>
#include <random>

#include "exr/exr_files.h"
#include "exr/reader.h"

namespace pullfocus::exr {
namespace {

using test::TempFolder;
using test::TestImage;

constexpr Window whole{-3, 0, 24, 18};

std::vector<std::string> seeds(const TempFolder& folder) {
  std::vector<std::string> files;
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
                                 Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    TestImage image({0, 0, 24, 18}, {-3, 2, 21, 17});
    image.add_rgbaz().add_noise("view.id", Imf::UINT).add_constant("flat", Imf::HALF, 1);
    image.header.compression() = compression;
    test::write_scanlines(folder / "seed.exr", image);
    files.push_back(test::file_bytes(folder / "seed.exr"));
    test::write_tiles(folder / "seed.exr", image, 16, 8);
    files.push_back(test::file_bytes(folder / "seed.exr"));
  }
  test::write_deep(folder / "seed.exr");
  files.push_back(test::file_bytes(folder / "seed.exr"));
  test::write_two_parts(folder / "seed.exr");
  files.push_back(test::file_bytes(folder / "seed.exr"));
  return files;
}

// Where the attributes of a file of one part begin and end: from one name to the next.
std::vector<std::string> attributes_of(const std::string& bytes) {
  std::vector<std::string> attributes;
  for (std::size_t at = 8; bytes[at] != 0;) {
    const std::size_t type = bytes.find('\0', at) + 1, size = bytes.find('\0', type) + 1;
    std::size_t length = 0;
    for (std::size_t i = 4; i-- > 0;) length = length << 8 | static_cast<unsigned char>(bytes[size + i]);
    attributes.push_back(bytes.substr(at, size + 4 + length - at));
    at = size + 4 + length;
  }
  return attributes;
}

// Writing over a file waits for the disk on some file systems; a new one does not.
void rewrite(const std::string& path, const std::string& bytes) {
  std::filesystem::remove(path);
  test::write_bytes(path, bytes);
}

// A file is read, or refused in one line that names it.
bool is_read(const std::string& path) {
  try {
    FrameReader reader(path);
    const Selection selection = select_channels(reader.info().channel_names(), {});
    Frame frame;
    ExtraChannels extra;
    reader.read(selection, whole, frame, &extra);
    EXPECT_EQ(frame.window(), whole);
    EXPECT_EQ(frame.depth.window(), whole);
    EXPECT_EQ(extra.channels.size(), selection.extra.size());
    return true;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_TRUE(error.code() == ErrorCode::unreadable || error.code() == ErrorCode::usage) << message;
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_GT(message.size(), path.size() + 5) << "it says nothing";
    EXPECT_TRUE(std::ranges::none_of(message, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
        << "not one plain line: " << message;
    return false;
  }
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  // One change; every second time near the front, where the header is.
  void change(std::string& bytes, const std::string& other) {
    if (bytes.empty()) return;
    const std::size_t reach = below(2) == 0 ? std::min<std::size_t>(bytes.size(), 500) : bytes.size();
    const std::size_t at = below(reach), length = 1 + below(std::min<std::size_t>(bytes.size() - at, 40));
    switch (below(8)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(below(bytes.size()), length));
        break;
      case 3:
        bytes.replace(at, length, other.substr(std::min(at, other.size()), length));
        break;
      case 4:
        for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(random_());
        break;
      case 5:  // a number of extremes
        bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at), std::string(4, "\0\xff\x7f\x80"[below(4)]));
        break;
      default:
        bytes[at] ^= static_cast<char>(1 << below(8));
    }
  }

 private:
  std::mt19937 random_;
};

TEST(Mutation, AnyChangesGiveAFrameOrOneClearError) {
  const TempFolder folder;
  const auto files = seeds(folder);
  Mutator mutate(11);
  int read = 0;
  constexpr int rounds = 12000;
  for (int round = 0; round < rounds && !HasFailure(); ++round) {
    std::string bytes = files[mutate.below(files.size())];
    const std::string& other = files[mutate.below(files.size())];
    for (std::size_t n = 1 + mutate.below(3); n > 0; --n) mutate.change(bytes, other);
    rewrite(folder / "changed.exr", bytes);
    read += is_read(folder / "changed.exr");
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(read, rounds / 50) << "nothing gets past the header";
  EXPECT_LT(read, rounds * 9 / 10) << "nothing is damaged";
}

TEST(Mutation, TheOrderOfAttributesDoesNotMatter) {
  const TempFolder folder;
  std::mt19937 random(12);
  auto files = seeds(folder);
  files.resize(files.size() - 2);  // one part each
  for (const std::string& bytes : files) {
    rewrite(folder / "a.exr", bytes);
    const TestImage expected = test::read_back(folder / "a.exr");
    auto attributes = attributes_of(bytes);
    for (int round = 0; round < 5; ++round) {
      std::shuffle(attributes.begin(), attributes.end(), random);
      std::string shuffled = bytes.substr(0, 8);
      for (const std::string& attribute : attributes) shuffled += attribute;
      rewrite(folder / "b.exr", shuffled + bytes.substr(shuffled.size()));
      ASSERT_TRUE(is_read(folder / "b.exr"));
      ASSERT_TRUE(test::read_back(folder / "b.exr").channels == expected.channels);
    }
  }
}

TEST(Mutation, AMissingOrRepeatedAttributeGivesAFrameOrOneClearError) {
  const TempFolder folder;
  auto files = seeds(folder);
  files.resize(files.size() - 2);
  for (const std::string& bytes : files) {
    const auto attributes = attributes_of(bytes);
    for (std::size_t changed = 0; changed < attributes.size(); ++changed) {
      for (const bool twice : {false, true}) {
        std::string text = bytes.substr(0, 8);
        std::size_t header = 8;
        for (std::size_t i = 0; i < attributes.size(); ++i) {
          header += attributes[i].size();
          if (i != changed || twice) text += attributes[i];
          if (i == changed && twice) text += attributes[i];
        }
        rewrite(folder / "changed.exr", text + bytes.substr(header));
        is_read(folder / "changed.exr");
        ASSERT_FALSE(HasFailure()) << attributes[changed].c_str() << (twice ? " twice" : " missing");
      }
    }
  }
}

}  // namespace
}  // namespace pullfocus::exr
