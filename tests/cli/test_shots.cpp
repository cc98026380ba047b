// Whole shots through the program: both methods, any threads, cut anywhere, the same pixels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "program.h"

namespace pullfocus::test {
namespace {

struct ShotCase {
  const char* name;
  std::string input;    // pattern
  std::string options;  // camera
  int first, last;
  std::string chunk;  // frames filtered alone
};

std::string frame_file(const ShotCase& shot, int frame) {
  const std::string name = shot.input.substr(shot.input.rfind('/') + 1);
  return fmt::format("{}{:04d}.exr", name.substr(0, name.find('#')), frame);
}

void expect_one_result(const ShotCase& shot) {
  const TempFolder out;
  const auto filter = [&](const std::string& folder, const std::string& more) {
    const Outcome outcome = run(fmt::format("filter '{}' -o '{}' --mkdir --compression none {} {}", shot.input,
                                            out / folder, shot.options, more));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  };
  const std::string all = fmt::format("--frames {}-{} ", shot.first, shot.last);
  filter("linear", all + "--method linear --threads 4");
  filter("linear1", all + "--method linear --threads 1");
  for (const int threads : {1, 2, 4}) filter(fmt::format("t{}", threads), all + fmt::format("--threads {}", threads));
  filter("chunk", "--threads 2 --frames " + shot.chunk);
  int compared = 0;
  for (int frame = shot.first; frame <= shot.last; ++frame) {
    const std::string file = frame_file(shot, frame);
    for (const char* other : {"linear1", "t1", "t2", "t4", "chunk"}) {
      const std::string path = out / (std::string(other) + "/" + file);
      if (std::string(other) == "chunk" && !std::ifstream(path)) continue;
      ASSERT_TRUE(same_pixels(out / ("linear/" + file), path)) << other;
      ++compared;
    }
  }
  EXPECT_GT(compared, 4 * (shot.last - shot.first + 1));
}

TEST(Shots, StarIsTheSameLinearAndIncrementalForAnyThreadsAndChunks) {
  const TempFolder shot;
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 97x61 --frames 30-45", shot.path())).code, 0);
  expect_one_result({"star", shot / "star-lateral.####.exr", "--lens paper", 30, 45, "34-37"});
}

TEST(Shots, BeachballIsTheSameLinearAndIncrementalForAnyThreadsAndChunks) {
  const std::string data = shared_data("beachball");
  if (data.empty()) GTEST_SKIP() << "needs ../shared/data/beachball";
  expect_one_result({"beachball", data + "/singlepart.####.exr",
                     "--focal-length 50 --fstop 0.5 --focus 9.3 --depth-kind planar", 1, 8, "5-8"});
}

TEST(Shots, MoverIsTheSameLinearAndIncrementalForAnyThreadsAndChunks) {
  const std::string data = shared_data("cycles/mover");
  if (data.empty()) GTEST_SKIP() << "needs ../shared/data/cycles/mover";
  expect_one_result({"mover", data + "/pinhole_####.exr", "--focal-length 50 --fstop 2 --focus 0.8", 1, 12, "5-8"});
}

TEST(Shots, WithBitmapsTheStarIsTheSameLinearAndIncrementalForAnyThreadsAndChunks) {
  const TempFolder shot;
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 97x61 --frames 30-45", shot.path())).code, 0);
  for (const int size : {16, 32, 64}) {
    expect_one_result({"star", shot / "star-lateral.####.exr",
                       fmt::format("--lens paper --visibility bitmap:{} --cutoff 0.5", size), 30, 45, "34-37"});
  }
}

TEST(Shots, WithBitmapsTheMoverIsTheSameLinearAndIncrementalForAnyThreadsAndChunks) {
  const std::string data = shared_data("cycles/mover");
  if (data.empty()) GTEST_SKIP() << "needs ../shared/data/cycles/mover";
  expect_one_result({"mover", data + "/pinhole_####.exr",
                     "--focal-length 50 --fstop 2 --focus 0.8 --visibility bitmap:32", 1, 12, "5-8"});
}

TEST(Shots, AFocusPullIsTheSameLinearAndIncremental) {
  const TempFolder shot;
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 64x48 --frames 1-8", shot.path())).code, 0);
  expect_one_result({"pull", shot / "star-lateral.####.exr",
                     "--lens paper --focus 1:0.02,5:0.1,8:inf --focus-interp smooth", 1, 8, "3-5"});
}

// Counters, not times: what the incremental filter writes and resolves on the paper's experiment 1.
TEST(Shots, AfterItsFirstFrameTheStarShotTakesATenthOfTheLinearWork) {
  const TempFolder folder;
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 256x256 --frames 20-25", folder.path())).code, 0);
  const auto stats_of = [&](const std::string& method) {
    EXPECT_EQ(run(fmt::format("filter '{}' -o '{}' --mkdir --lens paper --method {} --compression none --stats '{}'",
                              folder / "star-lateral.####.exr", folder / method, method, folder / (method + ".json")))
                  .code,
              0);
    std::ifstream file(folder / (method + ".json"));
    std::vector<nlohmann::json> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  };
  const auto linear = stats_of("linear"), incremental = stats_of("incremental");
  ASSERT_EQ(linear.size(), 6u);
  ASSERT_EQ(incremental.size(), 6u);
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_EQ(incremental[i]["mode"], "incremental");
    EXPECT_EQ(incremental[i]["left_over"], 0);
    EXPECT_LT(10 * incremental[i]["edges"].get<double>(), linear[i]["edges"].get<double>());
  }
}

}  // namespace
}  // namespace pullfocus::test
