// Pictures through the module: what is written comes back, and what cannot be read is named.
#include "imageio/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "exr_files.h"
#include "image/error.h"

namespace pullfocus::imageio {
namespace {

using exr::test::TempFolder;

Picture ramp(int width, int height, bool with_alpha) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float alpha = with_alpha ? static_cast<float>(y + 1) / static_cast<float>(height) : 1;
      const float v = static_cast<float>(x) / static_cast<float>(std::max(1, width - 1));
      for (const float value : {v * alpha, v * v * alpha, (1 - v) * alpha, alpha}) picture.rgba.push_back(value);
    }
  }
  return picture;
}

template <typename Call>
std::string error_of(Call&& call, ErrorCode code) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST(Srgb, EncodingAndDecodingAreInverseAndMeetTheStandard) {
  EXPECT_NEAR(srgb_encoded(0.18f), 0.4613561f, 1e-6f);
  EXPECT_NEAR(srgb_decoded(0.5f), 0.2140411f, 1e-6f);
  for (int i = 0; i <= 1000; ++i) {
    const float v = static_cast<float>(i) / 1000;
    EXPECT_NEAR(srgb_decoded(srgb_encoded(v)), v, 2e-6f);
  }
}

TEST(Picture, PngComesBackWithinHalfAStepOfSrgb) {
  const TempFolder folder;
  for (const bool with_alpha : {false, true}) {
    const Picture picture = ramp(37, 5, with_alpha);
    write_picture(folder / "a.png", picture);
    const Picture back = read_picture(folder / "a.png");
    ASSERT_EQ(back.width, 37);
    ASSERT_EQ(back.height, 5);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      const float alpha = picture.rgba[i + 3];
      EXPECT_NEAR(back.rgba[i + 3], alpha, 0.502f / 255);
      for (std::size_t c = i; c < i + 3; ++c) {
        const float is = srgb_encoded(back.rgba[c] / back.rgba[i + 3]), was = srgb_encoded(picture.rgba[c] / alpha);
        EXPECT_NEAR(is, was, 0.51f / 255) << "value " << c << (with_alpha ? " with alpha" : "");
      }
    }
  }
}

TEST(Picture, BytesAreTheSrgbEncodingRoundedToNearest) {
  const TempFolder folder;
  Picture grey{1, 1, {0.18f, 0.18f, 0.18f, 1}};
  write_picture(folder / "g.ppm", grey);
  const std::string bytes = exr::test::file_bytes(folder / "g.ppm");
  ASSERT_GE(bytes.size(), 3u);
  EXPECT_EQ(static_cast<unsigned char>(bytes.back()), 118);  // 0.4614 * 255
}

TEST(Picture, FloatsComeBackBitForBit) {
  const TempFolder folder;
  Picture picture = ramp(9, 4, true);
  picture.rgba[0] = 1234.5f;
  picture.rgba[1] = -0.25f;
  write_picture(folder / "a.exr", picture);
  EXPECT_EQ(read_picture(folder / "a.exr").rgba, picture.rgba);
}

TEST(Picture, ValuesOutsideTheRangeOfIntegersAreCutAndNaNIsBlack) {
  const TempFolder folder;
  write_picture(folder / "a.png", {2, 1, {9, -3, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1, 1, 1}});
  const Picture back = read_picture(folder / "a.png");
  EXPECT_EQ(back.rgba, (std::vector<float>{1, 0, 0, 1, 1, 1, 1, 1}));
}

TEST(Picture, WhatCannotBeReadIsNamed) {
  const TempFolder folder;
  exr::test::write_bytes(folder / "text.png", "no picture");
  exr::test::write_bytes(folder / "empty.png", "");
  exr::test::write_bytes(folder / "unknown.abc", "no picture");
  write_picture(folder / "whole.png", ramp(64, 64, false));
  const std::string whole = exr::test::file_bytes(folder / "whole.png");
  exr::test::write_bytes(folder / "cut.png", whole.substr(0, whole.size() / 2));
  for (const char* name : {"text.png", "empty.png", "unknown.abc", "cut.png", "missing.png"}) {
    const std::string message = error_of([&] { read_picture(folder / name); }, ErrorCode::unreadable);
    EXPECT_NE(message.find(name), std::string::npos) << message;
  }
  EXPECT_NE(error_of([&] { read_picture(folder.path()); }, ErrorCode::unreadable).find("folder"), std::string::npos);
}

TEST(Picture, AFailedWriteNamesTheFileAndLeavesWhatWasThere) {
  const TempFolder folder;
  for (const char* name : {"no/such/a.png", "a.unknown"}) {
    const auto message = error_of([&] { write_picture(folder / name, ramp(3, 3, false)); }, ErrorCode::unwritable);
    EXPECT_NE(message.find(name), std::string::npos) << message;
  }
  write_picture(folder / "kept.png", ramp(3, 3, false));
  const std::string before = exr::test::file_bytes(folder / "kept.png");
  error_of([&] { write_picture(folder / "kept.png", Picture{}); }, ErrorCode::unwritable);
  EXPECT_EQ(exr::test::file_bytes(folder / "kept.png"), before);
  EXPECT_EQ(folder.files().size(), 1u);
}

}  // namespace
}  // namespace pullfocus::imageio
