// What a batch run leaves behind does not depend on how many frames are in flight.
#include <OpenEXR/ImfStringAttribute.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "exr/header.h"
#include "exr/reader.h"
#include "exr/writer.h"
#include "filter/filter.h"
#include "program.h"

namespace pullfocus::test {
namespace {

namespace fs = std::filesystem;

// Half RGBA and float Z of noise: too large a file where others are small.
void write_noise(const std::string& path) {
  TestImage image({0, 0, 24, 18}, {0, 0, 24, 18});
  image.add_rgbaz();
  exr::test::write_scanlines(path, image);
}

class Batch : public testing::Test {
 protected:
  static constexpr int kFrames = 9;

  void SetUp() override { write_shot(folder, 1, kFrames); }

  std::string in(int frame) const { return folder / fmt::format("shot.{:04d}.exr", frame); }
  std::string command(const std::string& out, const std::string& options) const {
    return fmt::format("filter '{}' -o '{}' --mkdir --stats '{}' --focal-length 50 --fstop 2 --focus 2 {}",
                       folder / "shot.####.exr", folder / out, folder / (out + ".json"), options);
  }
  std::map<std::string, std::string> files(const std::string& out) const {
    std::map<std::string, std::string> found;
    if (!fs::exists(folder / out)) return found;
    for (const auto& entry : fs::directory_iterator(folder / out)) {
      found[entry.path().filename()] = entry.is_regular_file() ? exr::test::file_bytes(entry.path()) : "";
    }
    return found;
  }
  // Statistics without the times, line by line.
  std::vector<std::string> stats(const std::string& out) const {
    std::vector<std::string> lines;
    std::ifstream file(folder / (out + ".json"));
    for (std::string line; std::getline(file, line);) {
      auto json = nlohmann::ordered_json::parse(line);
      json.erase("ms");
      lines.push_back(json.dump());
    }
    return lines;
  }
  std::vector<int> frames_of_stats(const std::string& out) const {
    std::vector<int> frames;
    for (const std::string& line : stats(out)) frames.push_back(nlohmann::json::parse(line)["frame"]);
    return frames;
  }
  // With any number of threads: the same exit code, messages, files and statistics as with one, which works on one
  // frame after the other. Returns the outcome with one. `prepare` is called with each output folder's name.
  Outcome expect_same(const std::string& options, const std::function<void(const std::string&)>& prepare = {},
                      const std::function<Outcome(const std::string&)>& start = run) {
    const auto run_with = [&](int threads) {
      const std::string out = "out";
      fs::remove_all(folder / out);
      fs::remove(folder / (out + ".json"));
      if (prepare) prepare(out);
      return start(command(out, fmt::format("{} --threads {}", options, threads)));
    };
    const Outcome one = run_with(1);
    const auto one_files = files("out");
    const auto one_stats = stats("out");
    for (const int threads : {2, 8}) {
      for (int repeat = 0; repeat < 2; ++repeat) {
        const Outcome outcome = run_with(threads);
        EXPECT_EQ(outcome.code, one.code) << options;
        EXPECT_EQ(outcome.err, one.err) << options;
        EXPECT_EQ(files("out"), one_files) << options;
        EXPECT_EQ(stats("out"), one_stats) << options;
      }
    }
    return one;
  }

  TempFolder folder;
};

TEST_F(Batch, FilesAndStatisticsAreTheSameForAnyNumberOfThreads) {
  for (const char* options : {"", "--method linear --output-type float", "--budget 30%", "--output coc",
                              "--output depth", "--overscan 3,2,5,1", "--frames 9-1", "--frames 7,2,5 --mask A",
                              "--compression piz --repair-depth", "--visibility bitmap"}) {
    const Outcome outcome = expect_same(options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  EXPECT_EQ(files("out").size(), static_cast<std::size_t>(kFrames));
}

TEST_F(Batch, FilesEqualThoseOfReadingFilteringAndWritingOneFrameAfterTheOther) {
  ASSERT_EQ(run(command("out", "--threads 4 --visibility none")).code, 0);
  FilterOptions options;
  options.visibility.kind = VisibilityOptions::Kind::none;
  const Window window{0, 0, 24, 18};
  const auto filter = make_incremental_filter(window, options);
  ThinLens lens;
  lens.focal_length_mm = 50;
  lens.f_number = 2;
  lens.focus_distance = 2;
  const CocFunction coc = coc_function(lens, {24, 18, 1}, DepthKind::planar);
  for (int frame = 1; frame <= kFrames; ++frame) {
    exr::FrameReader reader(in(frame));
    const auto selection = exr::select_channels(reader.info().channel_names(), {});
    Frame pixels;
    exr::ExtraChannels extra;
    reader.read(selection, window, pixels, &extra);
    filter->filter(pixels, coc);
    const Window& reached = filter->result_window();
    auto channels = exr::colour_channels(filter->result(), selection, reached);
    const exr::ExtraChannels passed = exr::pass_through(extra, reached);
    for (const auto& channel : exr::extra_channels(passed)) channels.push_back(channel);
    Imf::Header header = exr::output_header(reader.info(), reached, "");
    const std::string name = fs::path(in(frame)).filename();
    const Imf::Header written = exr::read_header(folder / ("out/" + name)).header;
    for (const char* attribute : {"pullfocus.version", "pullfocus.method", "pullfocus.camera"}) {
      header.insert(attribute, written[attribute]);
    }
    exr::write_exr(folder / "sequential.exr", header, channels);
    EXPECT_EQ(exr::test::file_bytes(folder / "sequential.exr"), files("out")[name]) << name;
  }
}

TEST_F(Batch, StatisticsComeInTheOrderOfTheFrames) {
  ASSERT_EQ(run(command("out", "--frames 3,9-6,1 --threads 8")).code, 0);
  EXPECT_EQ(frames_of_stats("out"), (std::vector<int>{3, 9, 8, 7, 6, 1}));
}

TEST_F(Batch, AFrameThatCannotBeReadEndsTheRunAfterTheFramesBeforeIt) {
  const std::string whole = exr::test::file_bytes(in(5));
  exr::test::write_bytes(in(5), whole.substr(0, whole.size() - 20));
  exr::test::write_bytes(in(6), whole.substr(0, whole.size() - 10));
  const Outcome outcome = expect_same("");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.error_lines(), 1u);
  EXPECT_NE(outcome.err.find("frame 5: "), std::string::npos) << outcome.err;
  EXPECT_EQ(frames_of_stats("out"), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(files("out").size(), 4u);
}

TEST_F(Batch, BadFramesAreSkippedAndReportedInOrder) {
  const std::string whole = exr::test::file_bytes(in(5));
  exr::test::write_bytes(in(2), "not an EXR");
  for (const int frame : {5, 6, 9}) exr::test::write_bytes(in(frame), whole.substr(0, whole.size() - 20));
  const Outcome outcome = expect_same("--skip-bad-frames");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("frames 2,5-6,9 failed"), std::string::npos) << outcome.err;
  std::size_t last = 0;
  for (const char* name : {"shot.0002", "frame 5:", "frame 6:", "frame 9:"}) {
    const std::size_t at = outcome.err.find(name);
    ASSERT_NE(at, std::string::npos) << outcome.err;
    EXPECT_GE(at, last);
    last = at;
  }
  EXPECT_EQ(frames_of_stats("out"), (std::vector<int>{1, 3, 4, 7, 8}));
}

TEST_F(Batch, StrictEndsOrSkipsAtTheFrameThatIsNotClean) {
  TestImage image({0, 0, 24, 18}, {0, 0, 24, 18});
  for (const char* name : {"R", "G", "B", "A"}) image.add_constant(name, Imf::HALF, 1);
  image.add_constant("Z", Imf::FLOAT, -1);
  for (const int frame : {4, 6}) exr::test::write_scanlines(in(frame), image);
  Outcome outcome = expect_same("--strict");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("frame 4: "), std::string::npos) << outcome.err;
  EXPECT_EQ(files("out").size(), 3u);
  outcome = expect_same("--strict --skip-bad-frames");
  EXPECT_NE(outcome.err.find("frames 4,6 failed"), std::string::npos) << outcome.err;
  EXPECT_EQ(files("out").size(), 7u);
}

TEST_F(Batch, FramesThatAreThereAreKeptOnRequest) {
  const Outcome outcome = expect_same("--no-clobber", [&](const std::string& out) {
    fs::create_directory(folder / out);
    for (const int frame : {1, 4, 5}) {
      exr::test::write_bytes(folder / fmt::format("{}/shot.{:04d}.exr", out, frame), "kept");
    }
  });
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("frames 1,4-5 were there already"), std::string::npos) << outcome.err;
  EXPECT_EQ(files("out").at("shot.0004.exr"), "kept");
}

TEST_F(Batch, AFrameThatCannotBeWrittenEndsTheRunOrIsSkipped) {
  const auto occupy = [&](const std::string& out) { fs::create_directories(folder / (out + "/shot.0003.exr")); };
  Outcome outcome = expect_same("", occupy);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("shot.0003.exr"), std::string::npos) << outcome.err;
  EXPECT_EQ(frames_of_stats("out"), (std::vector<int>{1, 2}));
  outcome = expect_same("--skip-bad-frames", occupy);
  EXPECT_NE(outcome.err.find("frames 3 failed"), std::string::npos) << outcome.err;
  EXPECT_EQ(frames_of_stats("out").size(), static_cast<std::size_t>(kFrames - 1));
}

// A limit on the size of files stands for a full disk: the same calls fail, and later than the file was made.
TEST_F(Batch, AFileThatDoesNotFitLeavesNothingBehind) {
  for (const int frame : {4, 5}) write_noise(in(frame));
  const auto limited = [](const std::string& arguments) {
    return run_program("/bin/sh",
                       fmt::format("-c \"trap '' XFSZ; ulimit -f 10; exec '{}' {}\"", PULLFOCUS_PROGRAM, arguments));
  };
  Outcome outcome = expect_same("--output-type float --compression none --frames 1-3,6-9", {}, limited);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(files("out").empty());
  outcome = expect_same("", {}, limited);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("shot.0004.exr"), std::string::npos) << outcome.err;
  EXPECT_EQ(files("out").size(), 3u);
  outcome = expect_same("--skip-bad-frames", {}, limited);
  EXPECT_NE(outcome.err.find("frames 4-5 failed"), std::string::npos) << outcome.err;
  EXPECT_EQ(files("out").size(), 7u);
}

// The program's standard output is a pipe of one page, too little for the statistics of all frames, and is not emptied
// before the signal is sent: it comes in the middle of the run, whatever the machine is doing.
TEST_F(Batch, AStopInTheMiddleLeavesWholeFilesOfAllFramesBeforeIt) {
  write_shot(folder, 1, 60);
  for (const auto& [threads, policy] : {std::pair{"1", "--strict"}, {"4", "--strict"}, {"4", "--skip-bad-frames"}}) {
    fs::remove_all(folder / "out");
    fs::create_directory(folder / "out");
    int out[2];
    ASSERT_EQ(pipe(out), 0);
    ASSERT_GE(fcntl(out[1], F_SETPIPE_SZ, 4096), 4096);
    const std::string input = folder / "shot.####.exr", output = folder / "out", errors = folder / "err";
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      dup2(out[1], STDOUT_FILENO);
      dup2(open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
      close(out[0]);
      close(out[1]);
      execl(PULLFOCUS_PROGRAM, "pullfocus", "filter", input.c_str(), "-o", output.c_str(), "--threads", threads, policy,
            "--stats", "-", nullptr);
      _exit(127);
    }
    close(out[1]);
    std::string text;
    char buffer[512];
    for (ssize_t n = 1; n > 0;) {
      n = read(out[0], buffer, text.empty() ? 1 : sizeof buffer);
      if (n > 0 && text.empty()) kill(child, SIGINT);
      if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
    }
    close(out[0]);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);

    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    EXPECT_GE(lines, 1);
    EXPECT_LT(lines, 60);
    EXPECT_EQ(exr::test::file_bytes(errors),
              fmt::format("pullfocus: interrupted before frame {}: earlier frames are complete\n", lines + 1));
    EXPECT_EQ(files("out").size(), static_cast<std::size_t>(lines));
    for (int frame = 1; frame <= lines; ++frame) {
      exr::test::read_back(folder / fmt::format("out/shot.{:04d}.exr", frame));
    }
  }
}

}  // namespace
}  // namespace pullfocus::test
