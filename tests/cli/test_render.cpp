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

TEST(Render, WrongOptionsAreNamed) {
  for (const auto& [options, word] :
       std::vector<std::pair<std::string, std::string>>{{"teapot -o x", "teapot"},
                                                        {"star-lateral -o x --size 0x9", "--size"},
                                                        {"star-lateral -o x --size 9", "--size"},
                                                        {"star-lateral -o x --size 4294967305x9", "--size"},
                                                        {"star-lateral -o x --frames q", "q"},
                                                        {"star-lateral", "--out"}}) {
    const Outcome outcome = run("render " + options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u);
  }
}

}  // namespace
}  // namespace pullfocus::test
