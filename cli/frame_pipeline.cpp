#include "frame_pipeline.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace pullfocus::cli {

namespace {

class Pipeline {
 public:
  Pipeline(std::size_t count, std::size_t in_flight, FrameStages& stages)
      : count_(count), in_flight_(in_flight), stages_(stages), errors_(in_flight) {}

  std::size_t run() {
    using Mode = tbb::filter_mode;
    tbb::parallel_pipeline(
        in_flight_,
        tbb::make_filter<void, std::size_t>(Mode::serial_in_order, [&](tbb::flow_control& flow) {
          if (stopped_ || begun_ == count_) {
            flow.stop();
            return std::size_t{0};
          }
          return begin();
        }) & tbb::make_filter<std::size_t, std::size_t>(Mode::serial_in_order, [&](std::size_t frame) {
          attempt(&FrameStages::filter, frame);
          return frame;
        }) & tbb::make_filter<std::size_t, void>(Mode::serial_in_order, [&](std::size_t frame) { end(frame); }));
    return most_;
  }

 private:
  const std::size_t count_, in_flight_;
  FrameStages& stages_;
  std::vector<std::exception_ptr> errors_;  // by slot
  std::size_t begun_ = 0, most_ = 0;        // of the first stage alone
  std::atomic<std::size_t> ended_ = 0;
  std::atomic<bool> stopped_ = false;

  // Stages end in order, so the frames in flight follow each other and never share a slot.
  std::size_t slot(std::size_t frame) const noexcept { return frame % in_flight_; }

  std::size_t begin() {
    const std::size_t frame = begun_++;
    most_ = std::max(most_, begun_ - ended_);
    errors_[slot(frame)] = nullptr;
    attempt(&FrameStages::read, frame);
    return frame;
  }

  void end(std::size_t frame) {
    attempt(&FrameStages::write, frame);
    const std::exception_ptr error = std::exchange(errors_[slot(frame)], nullptr);
    if (error && !stopped_ && !stages_.failed(frame, error)) stopped_ = true;
    ++ended_;
  }

  void attempt(void (FrameStages::*stage)(std::size_t, std::size_t), std::size_t frame) {
    if (stopped_ || errors_[slot(frame)]) return;
    try {
      // Isolated: a stage that waits for parallel work of its own must not run another stage meanwhile.
      tbb::this_task_arena::isolate([&] { (stages_.*stage)(frame, slot(frame)); });
    } catch (...) {
      errors_[slot(frame)] = std::current_exception();
    }
  }
};

}  // namespace

std::size_t run_frames(std::size_t count, std::size_t in_flight, FrameStages& stages) {
  Pipeline pipeline(count, in_flight, stages);
  constexpr std::size_t kStages = 3;
  tbb::task_arena arena(static_cast<int>(std::min(in_flight, kStages)));
  return arena.execute([&] { return pipeline.run(); });
}

}  // namespace pullfocus::cli
