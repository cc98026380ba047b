// Artistic control and depth repair through the program.
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "exr/file_info.h"
#include "program.h"

namespace pullfocus::test {
namespace {

class Artistic : public testing::Test {
 protected:
  void SetUp() override { write_shot(folder, 1, 3); }

  Outcome filter(const std::string& options) {
    return run(fmt::format("filter '{}' -o '{}' --mkdir {}", folder / "shot.####.exr", folder / "out", options));
  }
  TestImage result(int frame) const { return exr::test::read_back(folder / fmt::format("out/shot.{:04d}.exr", frame)); }
  std::string attribute(const char* name) const {
    const auto info = exr::read_header(folder / "out/shot.0002.exr");
    const auto* found = info.header.findTypedAttribute<Imf::StringAttribute>(name);
    return found ? found->value() : "";
  }

  // Adds channel `hold` of that type to a frame: `value` in its left half, 0 elsewhere.
  void add_mask(int frame, Imf::PixelType type, float value) {
    const std::string path = folder / fmt::format("shot.{:04d}.exr", frame);
    TestImage image = exr::test::read_back(path);
    image.add_constant("hold", type, 0);
    const TestImage held = TestImage(image.display, image.data).add_constant("hold", type, value);
    std::vector<std::byte>& samples = image.channels["hold"].samples;
    const std::size_t row = samples.size() / 18;
    for (std::size_t y = 0; y < 18; ++y) {
      std::copy_n(&held.channels.at("hold").samples[y * row], row / 2, &samples[y * row]);
    }
    exr::test::write_scanlines(path, image);
  }
  // Pixels of the left half whose colour is the input's.
  int kept_pixels(int frame) const {
    const TestImage in = exr::test::read_back(folder / fmt::format("shot.{:04d}.exr", frame)), out = result(frame);
    int kept = 0;
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 12; ++x) {
        kept += in.value("R", x, y) == out.value("R", x, y) && in.value("G", x, y) == out.value("G", x, y) &&
                in.value("B", x, y) == out.value("B", x, y);
      }
    }
    return kept;
  }

  static constexpr const char* kBlurred = "--focus 4 --fstop 0.05 --focal-length 50 --mask hold";
  TempFolder folder;
};

TEST_F(Artistic, ScalesOfOneChangeNothingAndOfZeroGiveBackTheInput) {
  const exr::test::TestChannel input = exr::test::read_back(folder / "shot.0002.exr").channels.at("R");
  ASSERT_EQ(filter("--fstop 0.05 --focus 3").code, 0);
  const auto plain = result(2).channels;
  EXPECT_NE(plain.at("R"), input);
  ASSERT_EQ(filter("--fstop 0.05 --focus 3 --near-scale 1 --far-scale 1").code, 0);
  EXPECT_EQ(result(2).channels, plain);
  ASSERT_EQ(filter("--fstop 0.05 --focus 3 --near-scale 0 --far-scale 0").code, 0);
  EXPECT_EQ(result(2).channels.at("R"), input);
  EXPECT_NE(attribute("pullfocus.camera").find("near_scale=0 far_scale=0"), std::string::npos);
}

TEST_F(Artistic, ScalesAreInTheDiametersWrittenOut) {
  ASSERT_EQ(filter("--output coc --focus 3").code, 0);
  const TestImage plain = result(1);
  ASSERT_EQ(filter("--output coc --focus 3 --near-scale 2 --far-scale 0.5").code, 0);
  const TestImage scaled = result(1);
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 24; ++x) {
      const float c = plain.value("CoC", x, y);
      ASSERT_EQ(scaled.value("CoC", x, y), c < 0 ? 2 * c : 0.5f * c);
    }
  }
}

TEST_F(Artistic, AMaskHoldsItsPixelsOutWithBothMethods) {
  for (const char* method : {"incremental", "linear"}) {
    ASSERT_EQ(filter(fmt::format("--focus 4 --fstop 0.05 --mask B --method {}", method)).code, 0);
    const TestImage in = exr::test::read_back(folder / "shot.0003.exr"), out = result(3);
    int held_out = 0, blurred = 0;
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 24; ++x) {
        const bool same = in.value("G", x, y) == out.value("G", x, y) && in.value("R", x, y) == out.value("R", x, y);
        if (in.value("B", x, y) >= 0.5f) {
          ++held_out;
          ASSERT_TRUE(same) << x << "," << y;
        } else {
          blurred += !same;
        }
      }
    }
    EXPECT_GT(held_out, 100);
    EXPECT_GT(blurred, 100);
  }
  EXPECT_NE(attribute("pullfocus.method").find("mask=\"B\""), std::string::npos);
  const Outcome seen = run(fmt::format("inspect '{}' --mask B --explain 0,6", folder / "shot.####.exr"));
  EXPECT_NE(seen.out.find("are held out"), std::string::npos) << seen.out;
}

TEST_F(Artistic, AMaskMayChangeItsTypeFromFrameToFrameAndNaNHoldsNothingOut) {
  write_shot(folder, 4, 4);
  add_mask(1, Imf::HALF, 0.5f);
  add_mask(2, Imf::UINT, 1);
  add_mask(3, Imf::HALF, std::numeric_limits<float>::quiet_NaN());
  add_mask(4, Imf::FLOAT, 1);
  for (const char* method : {"incremental", "linear"}) {
    for (const char* visibility : {"none", "layers", "bitmap:16"}) {
      const Outcome done = filter(fmt::format("{} --method {} --visibility {}", kBlurred, method, visibility));
      ASSERT_EQ(done.code, 0) << done.err;
      for (const int frame : {1, 2, 4}) EXPECT_EQ(kept_pixels(frame), 12 * 18) << method << " frame " << frame;
      EXPECT_LT(kept_pixels(3), 6 * 18);
    }
  }
}

TEST_F(Artistic, AMaskThatOneFrameLacksMakesItABadFrameThatLeavesNoTrace) {
  add_mask(1, Imf::HALF, 1);
  add_mask(3, Imf::HALF, 1);
  const Outcome stopped = filter(kBlurred);
  EXPECT_EQ(stopped.code, 1);
  EXPECT_EQ(stopped.error_lines(), 1u) << stopped.err;
  for (const char* part : {"frame 2", "shot.0002.exr", "--mask hold"}) {
    EXPECT_NE(stopped.err.find(part), std::string::npos) << stopped.err;
  }
  EXPECT_EQ(filter(fmt::format("{} --skip-bad-frames", kBlurred)).code, 1);
  const TestImage skipped = result(3);
  ASSERT_EQ(filter(fmt::format("{} --frames 3", kBlurred)).code, 0);
  EXPECT_EQ(result(3).channels, skipped.channels);
  EXPECT_EQ(kept_pixels(3), 12 * 18);
}

TEST_F(Artistic, WrongScalesAndMasksAreNamedInOneLine) {
  for (const auto& [options, name] : {std::pair{"--near-scale -1", "--near-scale"},
                                      {"--far-scale inf", "--far-scale"},
                                      {"--far-scale nan", "--far-scale"},
                                      {"--mask holdout", "--mask holdout"}}) {
    const Outcome outcome = filter(options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  }
}

TEST_F(Artistic, AntialiasedDepthIsReportedAndRepaired) {
  TestImage image({0, 0, 20, 20}, {0, 0, 20, 20});
  for (const char* name : {"R", "G", "B", "A"}) image.add_constant(name, Imf::HALF, 1);
  image.add_constant("Z", Imf::FLOAT, 2);
  for (int y = 0; y < 20; ++y) {
    for (int x = 10; x < 20; ++x) {
      const float z = x == 10 ? 4.f : 8.f;  // a third of the farther surface
      std::memcpy(&image.channels["Z"].samples[static_cast<std::size_t>(y * 20 + x) * 4], &z, 4);
    }
  }
  exr::test::write_scanlines(folder / "soft.0001.exr", image);
  const std::string in = folder / "soft.0001.exr", lens = "--focal-length 50 --fstop 2 --focus 3";
  const Outcome seen = run(fmt::format("inspect '{}' {}", in, lens));
  EXPECT_NE(seen.out.find("looks ANTIALIASED: 20 pixels"), std::string::npos) << seen.out;
  EXPECT_NE(seen.out.find("--repair-depth"), std::string::npos);
  const Outcome fixed = run(fmt::format("inspect '{}' {} --repair-depth", in, lens));
  EXPECT_NE(fixed.out.find("20 mixed depths"), std::string::npos) << fixed.out;

  const std::string out = folder / "depth.0001.exr";
  const Outcome done = run(fmt::format("filter '{}' -o '{}' {} --repair-depth --output depth", in, out, lens));
  ASSERT_EQ(done.code, 0) << done.err;
  const TestImage depth = exr::test::read_back(out);
  for (int y = 0; y < 20; ++y) {
    EXPECT_EQ(depth.value("Z", 9, y), 2);
    EXPECT_EQ(depth.value("Z", 10, y), 2);
    EXPECT_EQ(depth.value("Z", 11, y), 8);
  }
  const std::string result = folder / "result.0001.exr";
  const Outcome stats = run(fmt::format("filter '{}' -o '{}' {} --repair-depth --stats -", in, result, lens));
  EXPECT_EQ(nlohmann::json::parse(stats.out).at("repaired").at("mixed"), 20) << stats.out;
  EXPECT_EQ(exr::test::read_back(result).channels.at("Z"), image.channels.at("Z"));  // passed on as it was
}

}  // namespace
}  // namespace pullfocus::test
