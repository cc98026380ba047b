#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputFile.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "exr/file_info.h"
#include "program.h"

namespace pullfocus::test {
namespace {

TEST(Render, StarLateralHasHalfColourFloatDepthAndItsLensInTheHeader) {
  const TempFolder folder;
  const Outcome outcome = run(fmt::format("render star-lateral -o '{}' --size 40x30 --frames 7,9-10", folder.path()));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{"star-lateral.0007.exr", "star-lateral.0009.exr", "star-lateral.0010.exr"}));
  const exr::FileInfo info = exr::read_header(folder / "star-lateral.0009.exr");
  EXPECT_EQ(info.display_window, (Window{0, 0, 40, 30}));
  ASSERT_EQ(info.channels.size(), 4u);
  EXPECT_EQ(info.find_channel("R")->type, Imf::HALF);
  EXPECT_EQ(info.find_channel("Z")->type, Imf::FLOAT);
  EXPECT_FLOAT_EQ(info.camera.focus_distance_m.value(), 0.04f);
  EXPECT_FLOAT_EQ(info.camera.fstop.value(), 3.5f);
  EXPECT_FLOAT_EQ(info.camera.focal_length_mm.value(), 8);
  EXPECT_NEAR(static_cast<double>(info.camera.sensor_height_mm.value()), 16. / 7, 1e-6);
}

TEST(Render, FramesDoNotDependOnWhichOthersAreRendered) {
  const TempFolder all, one;
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 32x32 --frames 40-44", all.path())).code, 0);
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 32x32 --frames 42 --threads 1", one.path())).code, 0);
  EXPECT_TRUE(same_pixels(all / "star-lateral.0042.exr", one / "star-lateral.0042.exr"));
}

TEST(Render, ShotsGivePictureDepthTruthAndDeepPixels) {
  const TempFolder folder;
  const std::string where = fmt::format("-o '{}' --size 32x18 --frames 2", folder.path());
  for (const char* what : {"--samples 2", "--truth 4", "--truth-views 4", "--deep"})
    ASSERT_EQ(run(fmt::format("render fearing-3 {} {}", where, what)).code, 0) << what;
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"fearing-3.0002.exr", "fearing-3.deep.0002.exr",
                                                      "fearing-3.truth.0002.exr", "fearing-3.views.0002.exr"}));
  const exr::FileInfo info = exr::read_header(folder / "fearing-3.0002.exr");
  EXPECT_EQ(info.find_channel("R")->type, Imf::HALF);
  EXPECT_EQ(info.find_channel("Z")->type, Imf::FLOAT);
  EXPECT_FLOAT_EQ(info.camera.fstop.value(), 12);
  EXPECT_FLOAT_EQ(info.camera.focal_length_mm.value(), 8);
  EXPECT_NEAR(static_cast<double>(info.camera.sensor_height_mm.value()), 8 * 16. / 70, 1e-5);
  const exr::FileInfo truth = exr::read_header(folder / "fearing-3.truth.0002.exr");
  EXPECT_EQ(truth.find_channel("R")->type, Imf::FLOAT);
  EXPECT_EQ(truth.find_channel("Z"), nullptr);
  EXPECT_EQ(run(fmt::format("filter '{0}/fearing-3.####.exr' -o '{0}/out' --mkdir", folder.path())).code, 0);
}

TEST(Render, DeepFilesHoldThePicturesDepthFirst) {
  const TempFolder folder;
  const std::string where = fmt::format("-o '{}' --size 20x11 --frames 1", folder.path());
  ASSERT_EQ(run(fmt::format("render branches {} --deep", where)).code, 0);
  ASSERT_EQ(run(fmt::format("render branches {} --samples 1", where)).code, 0);
  const TestImage flat = exr::test::read_back(folder / "branches.0001.exr");
  Imf::DeepScanLineInputFile file((folder / "branches.deep.0001.exr").c_str());
  ASSERT_NE(file.header().channels().findChannel("ZBack"), nullptr);
  std::vector<unsigned int> counts(20 * 11);
  std::vector<std::vector<float>> samples(counts.size());
  std::vector<char*> pointers(counts.size());
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * 20));
  buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), 8, 8 * 20, 4));
  file.setFrameBuffer(buffer);
  file.readPixelSampleCounts(0, 10);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    samples[i].resize(counts[i]);
    pointers[i] = reinterpret_cast<char*>(samples[i].data());
  }
  file.readPixels(0, 10);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 20; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * 20 + x);
      ASSERT_FALSE(samples[i].empty());
      EXPECT_EQ(samples[i].front(), flat.value("Z", x, y));
      EXPECT_EQ(samples[i].back(), 1e10f);
    }
}

TEST(Render, WrongOptionsAreNamed) {
  for (const auto& [options, word] :
       std::vector<std::pair<std::string, std::string>>{{"teapot -o x", "teapot"},
                                                        {"star-lateral -o x --size 0x9", "--size"},
                                                        {"star-lateral -o x --size 9", "--size"},
                                                        {"star-lateral -o x --size 4294967305x9", "--size"},
                                                        {"star-lateral -o x --frames q", "q"},
                                                        {"star-lateral -o x --truth 4", "truth"},
                                                        {"fearing-1 -o x --truth 4 --deep", "--deep"},
                                                        {"fearing-1 -o x --truth -1", "--truth"},
                                                        {"fearing-1 -o x --samples 0", "--samples"},
                                                        {"fearing-1 -o x --fstop 0", "--fstop"},
                                                        {"star-lateral", "--out"}}) {
    const Outcome outcome = run("render " + options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u);
  }
}

}  // namespace
}  // namespace pullfocus::test
