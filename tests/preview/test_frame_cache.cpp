// Frames in memory, read in the background.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "live_shot.h"

namespace pullfocus::cli::preview {
namespace {

using test::LiveShot;

constexpr std::size_t kFrameBytes = 24 * 18 * 12;

template <typename Done>
void wait_until(Done&& done) {
  for (int i = 0; i < 20000 && !done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(done());
}

std::vector<std::size_t> positions(const std::vector<bool>& loaded) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    if (loaded[i]) found.push_back(i);
  }
  return found;
}

TEST(FrameCache, ReadsNothingUntilAskedAndThenWhatWasAskedForFirst) {
  const LiveShot files(6);
  const Shot shot(files.arguments().input, {}, exr::BadFrames::keep);
  std::atomic<int> read = 0;
  std::vector<bool> after_first;
  FrameCache* cache_of_callback = nullptr;
  FrameCache cache(shot, 1 << 30, [&] {
    if (read++ == 0) after_first = cache_of_callback->loaded();
  });
  cache_of_callback = &cache;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(read, 0);
  EXPECT_EQ(cache.look(3).frame, nullptr);
  cache.get(3);
  wait_until([&] { return read == 6; });
  EXPECT_EQ(positions(after_first), std::vector<std::size_t>{3});
  EXPECT_EQ(positions(cache.loaded()).size(), 6u) << "all others after it, since they fit";
  cache.forget(0);
  cache.get(1);
  wait_until([&] { return cache.look(0).frame != nullptr; });
  EXPECT_EQ(cache.bytes(), 6 * kFrameBytes);
}

TEST(FrameCache, KeepsWithinItsMemoryAndHoldsWhatComesNext) {
  const LiveShot files(12);
  const Shot shot(files.arguments().input, {}, exr::BadFrames::keep);
  FrameCache cache(shot, 4 * kFrameBytes + 100, [] {});
  for (const std::size_t at : {0u, 5u, 6u, 11u, 2u}) {
    cache.get(at);
    std::vector<std::size_t> expected;  // the frame, two ahead, and the one before it
    for (std::size_t i = 0; i < 3; ++i) expected.push_back((at + i) % 12);
    expected.push_back((at + 11) % 12);
    wait_until([&] {
      EXPECT_LE(cache.bytes(), 4 * kFrameBytes + 100);
      for (const std::size_t i : expected) {
        if (!cache.look(i).frame) return false;
      }
      return true;
    });
  }
}

TEST(FrameCache, HoldsAFrameLargerThanItsMemory) {
  const LiveShot files(3);
  const Shot shot(files.arguments().input, {}, exr::BadFrames::keep);
  FrameCache cache(shot, 1, [] {});
  for (const std::size_t at : {2u, 0u}) {
    cache.get(at);
    wait_until([&] { return cache.look(at).frame != nullptr; });
    EXPECT_EQ(positions(cache.loaded()), std::vector<std::size_t>{at});
  }
}

TEST(FrameCache, SaysWhyAFrameCannotBeReadAndReadsItAgainWhenAsked) {
  const LiveShot files(3);
  const std::string path = files.folder / "shot.0002.exr";
  const std::string good = exr::test::file_bytes(path);
  const Shot shot(files.arguments().input, {}, exr::BadFrames::keep);
  std::ofstream(path, std::ios::binary) << good.substr(0, good.size() / 2);
  FrameCache cache(shot, 1 << 30, [] {});
  cache.get(1);
  wait_until([&] { return !cache.look(1).problem.empty(); });
  EXPECT_NE(cache.look(1).problem.find("frame 2"), std::string::npos) << cache.look(1).problem;
  EXPECT_NE(cache.look(1).problem.find(path), std::string::npos);
  std::ofstream(path, std::ios::binary) << good;
  cache.forget(1);
  cache.get(1);
  wait_until([&] { return cache.look(1).frame != nullptr; });
}

TEST(FrameCache, EndsInTheMiddleOfReading) {
  const LiveShot files(12);
  const Shot shot(files.arguments().input, {}, exr::BadFrames::keep);
  for (int i = 0; i < 20; ++i) {
    FrameCache cache(shot, 1 << 30, [] {});
    cache.get(static_cast<std::size_t>(i % 12));
  }
}

}  // namespace
}  // namespace pullfocus::cli::preview
