// Bad input: one clear line that names the file, frame, channel or option, the right exit code, and nothing lost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "program.h"

namespace pullfocus::test {
namespace {

constexpr char kCamera[] = "--focal-length 50 --fstop 2 --focus 2";

class BadInput : public testing::Test {
 protected:
  void SetUp() override { write_shot(folder, 1, 4); }

  // Runs `filter` on the shot; expects the exit code and one line that holds all words.
  void expect_failure(int code, const std::string& options, const std::vector<std::string>& words) {
    expect_failure_of(fmt::format("filter '{}' -o '{}' --mkdir {}", folder / "shot.####.exr", folder / "out", options),
                      code, words);
  }
  void expect_failure_of(const std::string& command, int code, const std::vector<std::string>& words) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
    expect_no_temporaries(folder);
    if (std::filesystem::exists(folder / "out")) {
      for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        exr::test::read_back(entry.path().string());  // whole and readable
      }
    }
  }
  bool written(int frame) const { return std::filesystem::exists(folder / fmt::format("out/shot.{:04d}.exr", frame)); }

  TempFolder folder;
};

TEST_F(BadInput, WrongOptionsAreNamedAndExitWithTwo) {
  const struct {
    const char* options;
    const char* word;
  } cases[] = {{"--focus 0", "--focus"},
               {"--focus -3", "--focus"},
               {"--focus nan", "--focus"},
               {"--focus 1:2,1:3", "--focus"},
               {"--fstop 0", "--fstop"},
               {"--fstop -1", "--fstop"},
               {"--focal-length 0", "--focal-length"},
               {"--focal-length inf", "--focal-length"},
               {"--focus 0.04 --lens paper", "--focus"},
               {"--lens fisheye", "--lens"},
               {"--sensor-width 0", "--sensor-width"},
               {"--sensor-fit diagonal", "--sensor-fit"},
               {"--unit 0", "--unit"},
               {"--depth-kind metres", "--depth-kind"},
               {"--depth-channel Q", "--depth-channel"},
               {"--layer Nothing", "--layer"},
               {"--view left", "--view"},
               {"--frames 5-", "5-"},
               {"--frames 1-10x0", "1-10x0"},
               {"--frames ''", "--frames"},
               {"--overscan 1,2", "--overscan"},
               {"--overscan=-1,0,0,0", "--overscan"},
               {"--focus-at 3", "--focus-at"},
               {"--focus-at 300,2", "--focus-at"},
               {"--focus 2 --focus-at 1,1", "--focus-at"},
               {"--method fast", "--method"},
               {"--budget 0%", "--budget"},
               {"--budget 101%", "--budget"},
               {"--budget many", "--budget"},
               {"--w-coc -1", "--w-coc"},
               {"--coc-threshold -1", "--coc-threshold"},
               {"--rgb-threshold inf", "--rgb-threshold"},
               {"--coc-step 2", "--coc-step"},
               {"--max-coc 501", "--max-coc"},
               {"--max-coc 0", "--max-coc"},
               {"--max-radiance 0", "--max-radiance"},
               {"--max-radiance 1e9", "--max-radiance"},
               {"--output-type uint", "--output-type"},
               {"--output layers", "--output"},
               {"--visibility magic", "--visibility"},
               {"--visibility bitmap:33", "--visibility"},
               {"--visibility bitmap:66", "--visibility"},
               {"--cutoff -1", "--cutoff"},
               {"--threads -2", "--threads"},
               {"--compression lzma", "--compression"},
               {"--no-such-option", "--no-such-option"},
               {"--focus @nowhere.toml", "nowhere.toml"},
               {"--config nowhere.toml", "nowhere.toml"}};
  for (const auto& c : cases) expect_failure(2, c.options, {c.word});
  EXPECT_FALSE(written(1));
}

TEST_F(BadInput, NoSubcommandOrInputIsWrongUsage) {
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("blur x").code, 2);
  EXPECT_EQ(run("filter").code, 2);
  EXPECT_EQ(run("filter x.exr").code, 2);
}

TEST_F(BadInput, ACameraThatIsNotCompleteNamesWhatIsMissing) {
  TestImage image({0, 0, 4, 4}, {0, 0, 4, 4});
  image.add_rgbaz();
  exr::test::write_scanlines(folder / "bare.0001.exr", image);
  const std::string command = fmt::format("filter '{}' -o '{}' ", folder / "bare.0001.exr", folder / "x.exr");
  expect_failure_of(command, 2, {"--focal-length", "--fstop", "--focus", "frame 1"});
  expect_failure_of(command + "--fstop 2 --focus 1", 2, {"--focal-length"});
  expect_failure_of(command + "--fstop 2 --focal-length 50", 2, {"--focus"});
}

TEST_F(BadInput, AMissingFrameIsNamed) {
  expect_failure(1, "--frames 1-6", {"frame 5", "shot.0005.exr"});
  expect_failure_of(fmt::format("filter '{}' -o '{}'", folder / "nothing.####.exr", folder / "out"), 1,
                    {"nothing.####.exr"});
  expect_failure_of(fmt::format("filter '{}' -o '{}'", folder / "nothing.exr", folder / "o.exr"), 1,
                    {"nothing.exr", "no such file"});
}

TEST_F(BadInput, AFrameOfAnotherDisplayWindowIsNamed) {
  TestImage image({0, 0, 30, 18}, {0, 0, 24, 18});
  image.add_rgbaz();
  exr::test::write_scanlines(folder / "shot.0003.exr", image);
  expect_failure(1, "", {"frame 3", "shot.0003.exr", "display window"});
}

TEST_F(BadInput, AFrameWithoutDepthIsNamedAndEarlierFramesStay) {
  TestImage image({0, 0, 24, 18}, {0, 0, 24, 18});
  for (const char* name : {"R", "G", "B"}) image.add_constant(name, Imf::HALF, 1);
  exr::test::write_scanlines(folder / "shot.0003.exr", image);
  expect_failure(1, kCamera, {"frame 3", "shot.0003.exr", "--depth-channel"});
  EXPECT_TRUE(written(1) && written(2));
  EXPECT_FALSE(written(3) || written(4));
}

TEST_F(BadInput, TwoCandidatesForDepthAreNamed) {
  TestImage image({0, 0, 24, 18}, {0, 0, 24, 18});
  for (const char* name : {"R", "G", "B"}) image.add_constant(name, Imf::HALF, 1);
  for (const char* name : {"a.Z", "b.Z"}) image.add_constant(name, Imf::FLOAT, 1);
  exr::test::write_scanlines(folder / "two.0001.exr", image);
  expect_failure_of(fmt::format("filter '{}' -o '{}' {}", folder / "two.0001.exr", folder / "o.exr", kCamera), 2,
                    {"a.Z", "b.Z", "--depth-channel"});
}

TEST_F(BadInput, TruncatedAndCorruptFilesAreNamedAndEarlierFramesStay) {
  const std::string whole = exr::test::file_bytes(folder / "shot.0003.exr");
  for (const std::size_t length : {std::size_t{0}, std::size_t{3}, whole.size() / 2, whole.size() - 1}) {
    std::filesystem::remove_all(folder / "out");
    exr::test::write_bytes(folder / "shot.0003.exr", whole.substr(0, length));
    expect_failure(1, "", {"frame 3", "shot.0003.exr"});
    EXPECT_FALSE(written(3) || written(4));
  }
}

TEST_F(BadInput, AnUnwritableOutputIsNamed) {
  exr::test::write_bytes(folder / "file", "x");
  const std::string input = folder / "shot.####.exr";
  expect_failure_of(fmt::format("filter '{}' -o '{}'", input, folder / "not/there/shot.####.exr"), 1, {"not/there"});
  expect_failure_of(fmt::format("filter '{}' -o '{}' --mkdir", input, folder / "file/below"), 1, {"file/below"});
  expect_failure_of(
      fmt::format("filter '{}' -o '{}' --stats '{}'", input, folder.path() + "/o.####.exr", folder / "no/s.json"), 1,
      {"--stats", "no/s.json"});
  expect_failure_of(fmt::format("filter '{}' -o '{}'", input, input), 2, {"shot"});
  expect_failure_of(fmt::format("filter '{}' -o '{}'", input, folder / "one.exr"), 2, {"one.exr"});
}

TEST_F(BadInput, StrictRefusesWhatWouldBeRepaired) {
  TestImage image({0, 0, 24, 18}, {0, 0, 24, 18});
  for (const char* name : {"R", "G", "B", "A"}) image.add_constant(name, Imf::HALF, 1);
  image.add_constant("Z", Imf::FLOAT, -1);
  exr::test::write_scanlines(folder / "shot.0002.exr", image);
  expect_failure(1, std::string("--strict ") + kCamera, {"frame 2", "--strict", "432", "Z"});
  EXPECT_TRUE(written(1));
  EXPECT_FALSE(written(2));
  const Outcome outcome = run(fmt::format("filter '{}' -o '{}' {}", folder / "shot.####.exr", folder / "out", kCamera));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("432 with an invalid depth"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pullfocus::test
