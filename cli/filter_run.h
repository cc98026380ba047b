// A batch run of `pullfocus filter`: every frame read, filtered and written, with its failures.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "filter/filter.h"
#include "filter_options.h"
#include "frame_pipeline.h"
#include "frame_writer.h"
#include "progress.h"
#include "shot.h"
#include "stats_file.h"

namespace pullfocus::cli {

struct RunArguments {
  std::string output, output_kind = "result", stats, compression;
  bool no_clobber = false, skip_bad_frames = false, strict = false, make_folder = false;
  bool only_copy = false;  // no option: frames are written as they were read, to measure what filtering adds
};

// Frames in flight with `threads` threads (>= 1): one is read, one filtered, one written and one waits. One thread
// alone gains nothing from a second frame.
constexpr std::size_t frames_in_flight(int threads) noexcept { return threads > 1 ? 4 : 1; }

// Bytes a pixel of the state window for the frames in flight and the filter's result. `frame` is one of the shot;
// `output` is the type of the result, unset: the input's.
double frame_bytes_per_pixel(const ShotFrame& frame, std::optional<SampleType> output, int threads);

class FilterRun : private FrameStages {
 public:
  // Checks everything that can be checked before the first frame. Throws Error.
  FilterRun(const InputArguments& input, const CameraArguments& camera, const FilterArguments& filter,
            const RunArguments& run);

  // Frames overlap (see FrameStages), but files, warnings, statistics and failures come in the order of the frames,
  // and a failure that ends the run leaves the files that it would leave if one frame came after the other. Returns the
  // exit code.
  int run();

 private:
  struct Slot {
    FrameRecord record;
    bool kept = false;  // --no-clobber: nothing to be done
    ShotFrame read;     // with other frames in flight, its colour becomes the result: the filter goes on with its own
    Window result_window;
    exr::ExtraChannels scratch;
  };

  void read(std::size_t frame, std::size_t slot) override;
  void filter(std::size_t frame, std::size_t slot) override;
  void write(std::size_t frame, std::size_t slot) override;
  bool failed(std::size_t frame, std::exception_ptr error) override;

  bool filters() const noexcept { return filter_ != nullptr; }
  void check_strictly(const Slot& slot) const;
  void write_file(int frame, Slot& slot);
  void add_to_totals(const FrameRecord& record);
  void say_summary() const;

  RunArguments arguments_;
  int threads_;
  OutputKind kind_;
  std::optional<Imf::Compression> compression_;
  Shot shot_;
  FrameWriter writer_;
  FilterOptions options_;
  std::string method_;  // for the files' headers
  LayerOf layer_of_;
  StatsFile stats_;
  std::unique_ptr<Filter> filter_;  // null: nothing is filtered
  std::vector<Slot> slots_;
  tbb::task_arena reading_;  // for depth repair, which works in parallel

  // Of write() and failed():
  std::unique_ptr<Progress> progress_;
  std::exception_ptr fatal_;     // what ended the run
  std::set<int> failed_, kept_;  // frames
  Stats totals_;                 // of repairs
  std::size_t outside_ = 0;
  std::int64_t mixed_ = 0;
};

}  // namespace pullfocus::cli
