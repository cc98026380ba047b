// Order, failures and bounds of overlapping stages.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <latch>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

#include "command.h"
#include "filter_run.h"
#include "frame_pipeline.h"

namespace pullfocus::cli {
namespace {

constexpr std::size_t kNever = ~std::size_t{0};

// Notes what is called, checks that it may be, and throws where it is told to.
class Recorder : public FrameStages {
 public:
  explicit Recorder(std::size_t in_flight) : owner_(in_flight, kNever) {}

  std::set<std::size_t> bad_reads, bad_filters, bad_writes;
  bool go_on = true;  // what failed() returns
  std::vector<std::size_t> read_frames, filtered, written, failed_frames, ends;
  std::vector<std::string> messages;
  std::size_t most = 0;

  void read(std::size_t frame, std::size_t slot) override {
    {
      const std::lock_guard lock(mutex_);
      EXPECT_EQ(owner_.at(slot), kNever) << "frame " << frame;
      owner_[slot] = frame;
      most = std::max(most, ++in_flight_);
      read_frames.push_back(frame);
    }
    stage("read", frame, slot, bad_reads);
  }
  void filter(std::size_t frame, std::size_t slot) override {
    filtered.push_back(frame);
    stage("filter", frame, slot, bad_filters);
  }
  void write(std::size_t frame, std::size_t slot) override {
    stage("write", frame, slot, bad_writes);
    written.push_back(frame);
    end(frame);
  }
  bool failed(std::size_t frame, std::exception_ptr error) override {
    failed_frames.push_back(frame);
    try {
      std::rethrow_exception(error);
    } catch (const std::exception& e) {
      messages.push_back(e.what());
    }
    end(frame);
    return go_on;
  }

 private:
  std::mutex mutex_;
  std::vector<std::size_t> owner_;  // of a slot
  std::size_t in_flight_ = 0;

  void stage(const char* name, std::size_t frame, std::size_t slot, const std::set<std::size_t>& bad) {
    {
      const std::lock_guard lock(mutex_);
      EXPECT_EQ(owner_.at(slot), frame) << name;
    }
    if (bad.contains(frame)) throw std::runtime_error(fmt::format("{} {}", name, frame));
  }
  void end(std::size_t frame) {
    const std::lock_guard lock(mutex_);
    const auto slot = std::find(owner_.begin(), owner_.end(), frame);
    ASSERT_NE(slot, owner_.end());
    *slot = kNever;
    --in_flight_;
    ends.push_back(frame);
  }
};

std::vector<std::size_t> numbers(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

class FramePipeline : public testing::Test {
 protected:
  void SetUp() override { use_threads(4, 2); }
};

TEST_F(FramePipeline, EveryStageTakesAllFramesInOrderWithinTheBound) {
  for (const std::size_t in_flight : {1, 2, 3, 4, 7}) {
    for (const std::size_t count : {0, 1, 2, 5, 200}) {
      Recorder recorder(in_flight);
      const std::size_t most = run_frames(count, in_flight, recorder);
      EXPECT_EQ(recorder.read_frames, numbers(count));
      EXPECT_EQ(recorder.filtered, numbers(count));
      EXPECT_EQ(recorder.written, numbers(count));
      EXPECT_LE(recorder.most, in_flight);
      EXPECT_GE(most, recorder.most);
      EXPECT_LE(most, in_flight);
    }
  }
}

// The turn of frame `first` to be written, or to fail, comes only after all frames that may be in flight with it have
// been begun: that could never be if stages waited for each other.
class Waiting : public Recorder {
 public:
  Waiting(std::size_t in_flight, std::size_t first)
      : Recorder(in_flight), first_(first), end_(first + in_flight), begun_(static_cast<std::ptrdiff_t>(in_flight)) {}
  void read(std::size_t frame, std::size_t slot) override {
    const Begun noted{*this, frame};
    Recorder::read(frame, slot);
  }
  void write(std::size_t frame, std::size_t slot) override {
    if (frame == first_) begun_.wait();
    Recorder::write(frame, slot);
  }
  bool failed(std::size_t frame, std::exception_ptr error) override {
    if (frame == first_) begun_.wait();
    return Recorder::failed(frame, error);
  }

 private:
  struct Begun {  // noted after the frame was counted, even if its read() throws
    Waiting& of;
    std::size_t frame;
    ~Begun() {
      if (frame >= of.first_ && frame < of.end_) of.begun_.count_down();
    }
  };
  const std::size_t first_, end_;
  std::latch begun_;
};

TEST_F(FramePipeline, FramesAreReadAheadUpToTheBoundWhileOneIsWritten) {
  for (const std::size_t in_flight : {2, 3, 4, 7}) {
    Waiting recorder(in_flight, 0);
    EXPECT_EQ(run_frames(20, in_flight, recorder), in_flight);
    EXPECT_EQ(recorder.most, in_flight);
    EXPECT_EQ(recorder.written, numbers(20));
  }
}

TEST_F(FramePipeline, AFrameThatFailsInAnyStageIsLeftOutInItsPlace) {
  for (const std::size_t in_flight : {1, 3, 4}) {
    Recorder recorder(in_flight);
    recorder.bad_reads = {2, 9};
    recorder.bad_filters = {3, 19};
    recorder.bad_writes = {0, 4};
    run_frames(20, in_flight, recorder);
    EXPECT_EQ(recorder.failed_frames, (std::vector<std::size_t>{0, 2, 3, 4, 9, 19}));
    EXPECT_EQ(recorder.messages,
              (std::vector<std::string>{"write 0", "read 2", "filter 3", "write 4", "read 9", "filter 19"}));
    EXPECT_EQ(recorder.ends, numbers(20));
    EXPECT_EQ(recorder.written.size(), 14u);
    EXPECT_EQ(std::count(recorder.filtered.begin(), recorder.filtered.end(), 2u), 0);
  }
}

TEST_F(FramePipeline, AfterAFailureThatEndsTheRunNothingIsWrittenOrReportedAny) {
  for (const std::size_t in_flight : {1, 3, 4, 7}) {
    for (const int stage : {0, 1, 2}) {
      Waiting recorder(in_flight, 6);
      recorder.go_on = false;
      (stage == 0 ? recorder.bad_reads : stage == 1 ? recorder.bad_filters : recorder.bad_writes) = {6};
      recorder.bad_reads.insert(7);  // fails before frame 6 does, if it is in flight with it
      run_frames(200, in_flight, recorder);
      EXPECT_EQ(recorder.written, numbers(6));
      EXPECT_EQ(recorder.failed_frames, std::vector<std::size_t>{6});
      EXPECT_EQ(recorder.read_frames, numbers(6 + in_flight));
    }
  }
}

TEST(FramesInFlight, AreFewAndOneWithoutThreads) {
  EXPECT_EQ(frames_in_flight(1), 1u);
  for (const int threads : {2, 4, 64, 1024}) EXPECT_LE(frames_in_flight(threads), 4u);
}

}  // namespace
}  // namespace pullfocus::cli
