// EXR files made for tests, written and read by plain OpenEXR calls.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "image/error.h"
#include "image/window.h"

namespace pullfocus::exr::test {

// A folder of its own, removed with all it holds.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }
  std::vector<std::string> files() const;  // sorted names

 private:
  std::string path_;
};

struct TestChannel {
  Imf::PixelType type = Imf::HALF;
  std::vector<std::byte> samples;  // over the data window, rows top down

  bool operator==(const TestChannel&) const = default;
};

// What a file holds. Attributes other than windows and compression are set in `header`.
struct TestImage {
  explicit TestImage(const Window& display, const Window& data);

  TestImage& add_noise(const std::string& name, Imf::PixelType type);  // any bits but NaN
  TestImage& add_constant(const std::string& name, Imf::PixelType type, float value);
  // The four halves R, G, B, A and a float Z, all noise.
  TestImage& add_rgbaz(const std::string& prefix = "");

  float value(const std::string& name, int x, int y) const;

  Window display, data;
  Imf::Header header;
  std::map<std::string, TestChannel> channels;

 private:
  void add(const std::string& name, TestChannel channel);
};

void write_scanlines(const std::string& path, const TestImage& image);
void write_tiles(const std::string& path, const TestImage& image, unsigned tile_width, unsigned tile_height,
                 bool mipmap = false);
void write_deep(const std::string& path);
void write_two_parts(const std::string& path);
TestImage read_back(const std::string& path);

std::string file_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

// Runs `call`, expects an Error of this code whose message holds all of `parts`, in one line.
template <typename Call>
void expect_error(ErrorCode code, const std::vector<std::string>& parts, Call call) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

}  // namespace pullfocus::exr::test
