// --kernel and what belongs to it, through the real program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "imageio/picture.h"
#include "program.h"

namespace pullfocus::test {
namespace {

namespace fs = std::filesystem;

class KernelOptionsOfTheProgram : public testing::Test {
 protected:
  void SetUp() override {
    write_shot(folder, 1, 3);
    imageio::Picture letter{8, 8, {}};
    for (int i = 0; i < 64; ++i) {
      const float v = i % 8 < 3 || i < 16 ? 1.f : 0.f;
      letter.rgba.insert(letter.rgba.end(), {v, v, v, 1});
    }
    imageio::write_picture(folder / "letter.png", letter);
    std::fill(letter.rgba.begin(), letter.rgba.end(), 0.f);
    imageio::write_picture(folder / "black.png", letter);
  }
  std::string command(const std::string& name, const std::string& options) {
    return fmt::format("{} '{}' {}", name, folder / "shot.####.exr", options);
  }
  std::string out(const std::string& name) { return fmt::format("-o '{}' --mkdir ", folder / name); }
  std::string kernel(const std::string& text) { return fmt::format("--kernel '{}' ", text); }
  std::string picture(const std::string& name) { return kernel("image:" + (folder / name)); }

  TempFolder folder;
};

TEST_F(KernelOptionsOfTheProgram, EveryKernelGivesTheSamePixelsIncrementallyAndLinearlyAndTheyDiffer) {
  std::vector<std::string> results;
  const std::string rotated = kernel("polygon:5") + "--blade-rotation 20 --blade-roundness 0.4 ";
  for (const std::string& k : {std::string(), kernel("polygon:5"), rotated, kernel("gaussian"), kernel("diffraction"),
                               picture("letter.png")}) {
    const std::string name = std::to_string(results.size());
    ASSERT_EQ(run(command("filter", k + out(fmt::format("i{}", name)) + "--fstop 0.5")).code, 0) << k;
    ASSERT_EQ(run(command("filter", k + out(fmt::format("l{}", name)) + "--fstop 0.5 --method linear")).code, 0) << k;
    const std::string result = folder / fmt::format("i{}/shot.0003.exr", name);
    EXPECT_TRUE(same_pixels(result, folder / fmt::format("l{}/shot.0003.exr", name))) << k;
    for (const std::string& other : results) EXPECT_FALSE(same_pixels(result, other)) << k;
    results.push_back(result);
  }
}

TEST_F(KernelOptionsOfTheProgram, InspectNamesTheKernelAndItsCost) {
  const auto says = [&](const std::string& options) { return run(command("inspect", options)).out; };
  EXPECT_NE(says("").find("kernel        disc\n"), std::string::npos);
  EXPECT_NE(says(kernel("polygon:5") + "--blade-roundness 0.25").find("polygon:5, rotation 0, roundness 0.25; turned"),
            std::string::npos);
  EXPECT_NE(says(kernel("gaussian")).find("run edges a source"), std::string::npos);
  EXPECT_NE(says(picture("letter.png")).find("image, 8x8 pixels; turned"), std::string::npos);
}

TEST_F(KernelOptionsOfTheProgram, AConfigFileMayHoldThem) {
  exr::test::write_bytes(folder / "c.toml", "kernel = \"polygon:7\"\nblade-rotation = 12.5\n");
  const Outcome outcome = run(command("inspect", fmt::format("--config '{}'", folder / "c.toml")));
  EXPECT_NE(outcome.out.find("polygon:7, rotation 12.5"), std::string::npos) << outcome.out << outcome.err;
}

TEST_F(KernelOptionsOfTheProgram, MistakesAreOneLineThatNamesTheOptionAndExitWithTwo) {
  exr::test::write_bytes(folder / "bad.png", "no picture");
  exr::test::write_bytes(folder / "empty.png", "");
  const std::pair<std::string, std::string> cases[] = {{kernel("star"), "--kernel"},
                                                       {kernel("polygon:2"), "--kernel"},
                                                       {kernel("polygon:17"), "--kernel"},
                                                       {kernel("polygon:x"), "--kernel"},
                                                       {kernel("image:"), "image:FILE"},
                                                       {picture("missing.png"), "missing.png: no such file"},
                                                       {picture("bad.png"), "bad.png"},
                                                       {picture("empty.png"), "empty.png"},
                                                       {picture("black.png"), "black.png: the picture is black"},
                                                       {kernel("image:" + folder.path()), "folder"},
                                                       {"--blade-roundness 1.5", "--blade-roundness"},
                                                       {"--blade-rotation nan", "--blade-rotation"}};
  for (const auto& [options, word] : cases) {
    for (const char* name : {"filter", "inspect"}) {
      const Outcome outcome =
          run(command(name, fmt::format("{} {}", options, name[0] == 'f' ? out("o") : std::string())));
      EXPECT_EQ(outcome.code, 2) << options;
      EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
    }
  }
}

// The module is found in an installed tree, and missed with a clear error where it is not.
TEST_F(KernelOptionsOfTheProgram, PicturesWorkInAnInstalledTreeAndTellWhatIsMissingInABrokenOne) {
  const fs::path tool = PULLFOCUS_PROGRAM, module = tool.parent_path() / "../lib/pullfocus/pullfocus_oiio.so";
  ASSERT_TRUE(fs::exists(module)) << module;
  fs::create_directories(folder / "bin");
  fs::copy(tool, folder / "bin/pullfocus");
  const std::string command = fmt::format("inspect '{}' {}", folder / "shot.####.exr", picture("letter.png"));
  const Outcome broken = run_program(folder / "bin/pullfocus", command);
  EXPECT_EQ(broken.code, 2);
  EXPECT_EQ(broken.error_lines(), 1u);
  EXPECT_NE(broken.err.find("pullfocus_oiio.so"), std::string::npos) << broken.err;
  EXPECT_EQ(run_program(folder / "bin/pullfocus", fmt::format("inspect '{}'", folder / "shot.####.exr")).code, 0);
  fs::create_directories(folder / "lib/pullfocus");
  fs::copy(module, folder / "lib/pullfocus/pullfocus_oiio.so");
  EXPECT_EQ(run_program(folder / "bin/pullfocus", command).code, 0);
}

}  // namespace
}  // namespace pullfocus::test
