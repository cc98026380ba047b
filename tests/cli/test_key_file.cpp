#include "key_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "usage.h"

namespace pullfocus {
namespace {

namespace fs = std::filesystem;

class KeyFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("pullfocus_key_file_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file() const { return folder_ / "keys.toml"; }
  fs::path write(std::string_view text) const {
    std::ofstream(file(), std::ios::binary) << text;
    return file();
  }
  CameraKeys load(std::string_view text) const { return load_camera_keys(write(text)); }

  fs::path folder_;
};

TEST_F(KeyFile, SavedKeysLoadEqual) {
  CameraKeys keys;
  keys.interpolation = FocusInterp::smooth;
  keys.focus = KeyedValue::parse("-2:0.1,1:0.30000000000000004,24:inf", "", Infinity::legal);
  keys.fstop = KeyedValue::parse("2", "", Infinity::refused);
  keys.focal_length = KeyedValue::parse("1:50,24:1e20", "", Infinity::refused);
  save_camera_keys(keys, file());
  EXPECT_EQ(load_camera_keys(file()), keys);
  save_camera_keys({}, file());  // replaces
  EXPECT_EQ(load_camera_keys(file()), CameraKeys{});
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing but the file itself is left";
}

TEST_F(KeyFile, EveryEntryMayBeMissing) {
  EXPECT_EQ(load(""), CameraKeys{});
  const CameraKeys keys = load("focus = [[1, 0.4],\n [24, inf]] # pull\n");
  EXPECT_EQ(keys.focus->to_string(), "1:0.4,24:inf");
  EXPECT_FALSE(keys.fstop || keys.focal_length);
  EXPECT_EQ(keys.interpolation, FocusInterp::dioptre);
}

TEST_F(KeyFile, WholeNumbersAreValuesToo) {
  EXPECT_EQ(load("fstop = 2").fstop->to_string(), "2");
  EXPECT_EQ(load("focal_length = [[1, 50], [2, 85]]").focal_length->to_string(), "1:50,2:85");
}

TEST_F(KeyFile, WholeNumbersBeyondThoseOfADoubleAreRounded) {
  EXPECT_EQ(load("focus = 9223372036854775807").focus->linear_at(0), 0x1p63);
  EXPECT_EQ(load("focus = [[1, 9007199254740993]]").focus->linear_at(1), 0x1p53);
}

TEST_F(KeyFile, WrongTextIsRefusedByFileAndLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"fstop = 2\nfocus = [[1, 0.4], [1, 0.5]]", "keys.toml:2: focus: has two keys"},
      {"fstop = 2\nfocus = [[1, 0.4],\n [2, -1]]", "keys.toml:2: focus: must be a positive"},
      {"focus = [[1, 0.4],\n [2.5, 1]]", "keys.toml:2: focus: each key"},
      {"focus = [1, 2]", "keys.toml:1: focus: each key"},
      {"focus = [[1, 2, 3]]", "keys.toml:1: focus: each key"},
      {"focus = [[1, \"2\"]]", "keys.toml:1: focus: each key"},
      {"focus = [[99999999999, 2]]", "keys.toml:1: focus: frame number"},
      {"focus = []", "keys.toml:1: focus: has no keys"},
      {"focus = \"near\"", "keys.toml:1: focus: must be a number or"},
      {"fstop = inf", "keys.toml:1: fstop: must be finite"},
      {"\nfocal_length = nan", "keys.toml:2: focal_length: must be a positive"},
      {"interpolation = \"cubic\"", "keys.toml:1: interpolation: 'cubic'"},
      {"interpolation = 3", "keys.toml:1: interpolation: must be"},
      {"fstop = 2\nfocsu = 3", "keys.toml:2: focsu: is none of"},
      {"fstop = 2\nfocus = [[1, 0.4]", "keys.toml:2: not TOML"},
  };
  for (const auto& [text, message] : wrong) expect_usage_error([&, t = text] { load(t); }, message);
}

TEST_F(KeyFile, MissingFileAndFolderAreUnreadable) {
  for (const fs::path& path : {file(), folder_}) try {
      load_camera_keys(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unreadable);
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
}

TEST_F(KeyFile, UnwritablePlaceIsReported) {
  try {
    save_camera_keys({}, folder_ / "missing" / "keys.toml");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unwritable);
  }
}

}  // namespace
}  // namespace pullfocus
