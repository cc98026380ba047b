#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "exr/file_info.h"
#include "program.h"

namespace pullfocus::test {
namespace {

class FilterCommand : public testing::Test {
 protected:
  void SetUp() override { write_shot(folder, 1, 6); }

  Outcome filter(const std::string& options) {
    return run(fmt::format("filter '{}' -o '{}' --mkdir {}", folder / "shot.####.exr", folder / "out", options));
  }
  std::string out(int frame) const { return folder / fmt::format("out/shot.{:04d}.exr", frame); }

  TempFolder folder;
};

TEST_F(FilterCommand, TakesTheCameraFromTheHeader) {
  ASSERT_EQ(filter("").code, 0);
  EXPECT_EQ(filter("--output-type half").code, 0);
  const auto info = exr::read_header(out(3));
  const auto* camera = info.header.findTypedAttribute<Imf::StringAttribute>("pullfocus.camera");
  ASSERT_NE(camera, nullptr);
  EXPECT_NE(camera->value().find("focal_length_mm=50 fstop=2 focus=2 "), std::string::npos) << camera->value();
}

TEST_F(FilterCommand, AnOptionWinsOverTheHeader) {
  ASSERT_EQ(filter("--focus 4").code, 0);
  const TestImage far = exr::test::read_back(out(1));
  ASSERT_EQ(filter("").code, 0);
  EXPECT_NE(far.channels, exr::test::read_back(out(1)).channels);
}

TEST_F(FilterCommand, PassesDepthThroughAndKeepsTypesAndCompression) {
  ASSERT_EQ(filter("").code, 0);
  const TestImage in = exr::test::read_back(folder / "shot.0002.exr"), result = exr::test::read_back(out(2));
  EXPECT_EQ(in.channels.at("Z"), result.channels.at("Z"));
  EXPECT_EQ(result.channels.at("R").type, Imf::HALF);
  EXPECT_EQ(exr::read_header(out(2)).compression, exr::read_header(folder / "shot.0002.exr").compression);
  ASSERT_EQ(filter("--output-type float --compression piz").code, 0);
  EXPECT_EQ(exr::test::read_back(out(2)).channels.at("R").type, Imf::FLOAT);
  EXPECT_EQ(exr::read_header(out(2)).compression, Imf::PIZ_COMPRESSION);
}

TEST_F(FilterCommand, ItsResultDiffersFromItsInput) {
  ASSERT_EQ(filter("").code, 0);
  EXPECT_NE(exr::test::read_back(folder / "shot.0002.exr").channels.at("R"),
            exr::test::read_back(out(2)).channels.at("R"));
}

TEST_F(FilterCommand, StatsHaveOneLineAFrameThatAddsUp) {
  ASSERT_EQ(filter(fmt::format("--budget 40% --stats '{}'", folder / "stats.json")).code, 0);
  std::ifstream file(folder / "stats.json");
  int frame = 0;
  for (std::string line; std::getline(file, line);) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["frame"], ++frame);
    EXPECT_EQ(json["width"], 24);
    EXPECT_EQ(json["height"], 18);
    EXPECT_EQ(json["changed"].get<int>(), json["updated"].get<int>() + json["left_over"].get<int>());
    for (const char* key : {"colour", "depth", "clamped", "outside"}) EXPECT_EQ(json["repaired"][key], 0) << key;
    for (const char* key : {"read", "detect", "scatter", "resolve", "filter", "write"}) EXPECT_GE(json["ms"][key], 0);
    EXPECT_EQ(json["mode"] == "rebuild", frame == 1);
    EXPECT_EQ(json["left_over"] > 0, frame > 1);
  }
  EXPECT_EQ(frame, 6);
}

TEST_F(FilterCommand, ExistingFramesAreKeptOnRequest) {
  ASSERT_EQ(filter("--frames 2").code, 0);
  const std::string before = exr::test::file_bytes(out(2));
  const Outcome outcome = filter("--focus 9 --no-clobber");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("frames 2 were there already"), std::string::npos) << outcome.err;
  EXPECT_EQ(exr::test::file_bytes(out(2)), before);
  EXPECT_NE(exr::test::file_bytes(out(3)), "");
}

TEST_F(FilterCommand, WritesTheDiametersAndTheDepthItWorksWith) {
  ASSERT_EQ(filter("--output coc --frames 1").code, 0);
  const TestImage coc = exr::test::read_back(out(1));
  // 50 mm at f/2 on 36 mm and 24 px: 50 * 50 / 2 / 1000 * 24 / 36 px m, times 1/2 - 1/z.
  const double scale = 50. * 50 / 2 / 1000 * 24 / 36;
  EXPECT_NEAR(static_cast<double>(coc.value("CoC", 20, 1)), scale * (1 / 2. - 1 / 7.), 1e-5);
  EXPECT_EQ(coc.value("CoC", 5, 8), 0);
  ASSERT_EQ(filter("--output depth --frames 1").code, 0);
  EXPECT_EQ(exr::test::read_back(out(1)).value("Z", 20, 1), 7);
}

TEST_F(FilterCommand, WritesEachPixelsLayer) {
  const auto layers_at = [&](const std::string& options) {  // of the wall, of the ball in focus
    EXPECT_EQ(filter("--output layer --frames 1 " + options).code, 0);
    const TestImage image = exr::test::read_back(out(1));
    EXPECT_EQ(image.channels.size(), 1u);
    return std::pair(image.value("layer", 20, 1), image.value("layer", 5, 8));
  };
  using Of = std::pair<float, float>;
  EXPECT_EQ(layers_at("--fstop 0.02"), Of(2, 1)) << "30 px";
  EXPECT_EQ(layers_at("--fstop 2"), Of(1, 1)) << "0.3 px";
  EXPECT_EQ(layers_at("--fstop 0.02 --focus 9 --visibility layers:-8,-1,1"), Of(1, 0)) << "-2.6 px, -32 px";
  EXPECT_EQ(layers_at("--fstop 0.02 --visibility layers:1,9,99"), Of(2, 0));
  EXPECT_EQ(layers_at("--fstop 0.02 --visibility none"), Of(0, 0));
}

TEST_F(FilterCommand, FocusAtAPixelIsFocusAtItsDepthInTheFirstFrameOfTheShot) {
  ASSERT_EQ(filter("--focus 6.8").code, 0);
  const TestImage by_distance = exr::test::read_back(out(5));
  // Column 19 is the wall at 6.8 m; in every chunk of the shot frame 1 decides.
  ASSERT_EQ(filter("--focus-at 19,0 --frames 5").code, 0);
  EXPECT_EQ(exr::test::read_back(out(5)).channels, by_distance.channels);
}

TEST_F(FilterCommand, OverscanGivesRoomAroundThePicture) {
  ASSERT_EQ(filter("--overscan 3,2,5,0 --fstop 0.02").code, 0);
  EXPECT_EQ(exr::test::read_back(out(1)).data, (Window{-3, -2, 29, 18}));
  EXPECT_EQ(exr::test::read_back(out(1)).display, (Window{0, 0, 24, 18}));
}

TEST_F(FilterCommand, DataOutsideTheStateWindowIsIgnoredAndCounted) {
  const Window display{0, 0, 20, 20}, data{-4, 0, 20, 20};
  TestImage image(display, data);
  image.add_rgbaz();
  exr::test::write_scanlines(folder / "over.0001.exr", image);
  const Outcome outcome = run(fmt::format(
      "filter '{}' -o '{}' --fstop 2 --focal-length 50 --focus 1 --depth-kind coc --max-coc 9 --overscan 0,0,0,0 "
      "--stats -",
      folder / "over.0001.exr", folder / "over.result.exr"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["repaired"]["outside"], 80);
}

TEST_F(FilterCommand, ABadFrameIsSkippedOnRequestAndListed) {
  exr::test::write_bytes(folder / "shot.0003.exr", "not an EXR");
  const Outcome outcome = filter("--skip-bad-frames");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("frames 3 failed"), std::string::npos) << outcome.err;
  EXPECT_EQ(exr::test::file_bytes(out(3)), "");
  const TestImage after = exr::test::read_back(out(6));
  ASSERT_EQ(filter("--frames 6").code, 0);
  EXPECT_EQ(exr::test::read_back(out(6)).channels, after.channels);
}

TEST_F(FilterCommand, HelpNamesEveryOptionAndExitsWithZero) {
  const Outcome outcome = run("filter --help");
  EXPECT_EQ(outcome.code, 0);
  for (const char* option : {"--focus-at", "--output", "--budget", "--overscan", "--threads", "--config", "--strict"}) {
    EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
  }
}

}  // namespace
}  // namespace pullfocus::test
