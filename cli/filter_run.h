// A batch run of `pullfocus filter`: every frame read, filtered and written, with its failures.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exr/header.h"
#include "exr/output_names.h"
#include "filter/filter.h"
#include "filter_options.h"
#include "shot.h"
#include "stats_file.h"

namespace pullfocus::cli {

enum class OutputKind { result, coc, depth };
OutputKind parse_output_kind(const std::string& text);  // throws Error(usage)

struct RunArguments {
  std::string output, output_kind = "result", stats, compression;
  bool no_clobber = false, skip_bad_frames = false, strict = false, make_folder = false;
};

class FilterRun {
 public:
  // Checks everything that can be checked before the first frame. Throws Error.
  FilterRun(const InputArguments& input, const CameraArguments& camera, const FilterArguments& filter,
            const RunArguments& run);

  int run();  // exit code

 private:
  void do_frame(const exr::SequenceFrame& from);
  void check_strictly(const FrameRecord& record) const;
  void write_result(const exr::SequenceFrame& from);
  void write_values(const exr::SequenceFrame& from);
  Imf::Header header(const exr::SequenceFrame& from, const Window& data_window) const;
  void say_summary() const;

  RunArguments arguments_;
  OutputKind kind_;
  std::optional<Imf::Compression> compression_;
  Shot shot_;
  exr::OutputNames names_;
  FilterOptions options_;
  std::string method_;
  StatsFile stats_;
  std::unique_ptr<Filter> filter_;
  ShotFrame current_;
  std::set<int> failed_, kept_;  // frames
  Stats totals_;                 // of repairs
  std::size_t outside_ = 0;
  std::int64_t mixed_ = 0;
};

}  // namespace pullfocus::cli
