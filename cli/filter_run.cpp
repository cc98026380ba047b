#include "filter_run.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <filesystem>

#include "command.h"
#include "exr/range.h"
#include "filter/core.h"
#include "image/error.h"

namespace pullfocus::cli {

namespace {

// The stages that read and write wait for OpenEXR's threads: they must not take threads from the filter.
constexpr int kWaitingThreads = 2;

std::optional<Imf::Compression> compression_of(const RunArguments& run) {
  if (run.compression.empty()) return std::nullopt;
  return exr::parse_compression(run.compression);
}

// Ends the run whatever --skip-bad-frames says.
class Interrupted : public Error {
 public:
  explicit Interrupted(int frame)
      : Error(ErrorCode::content, fmt::format("interrupted before frame {}: earlier frames are complete", frame)) {}
};

}  // namespace

double frame_bytes_per_pixel(const ShotFrame& frame, std::optional<SampleType> output, int threads) {
  const double input = static_cast<double>(frame.frame.colour.pixel_bytes());
  const double result = 4. * static_cast<double>(sample_bytes(output.value_or(frame.frame.colour.type())));
  double others = 4;  // depth
  if (frame.frame.has_mask()) others += 4;
  for (const exr::NamedChannel& extra : frame.selection.extra) {
    const exr::ChannelInfo* channel = frame.file.find_channel(extra.file_name);
    if (channel != nullptr) others += static_cast<double>(exr::sample_bytes(channel->type));
  }
  const std::size_t in_flight = frames_in_flight(threads);
  const double colour = in_flight > 1 ? std::max(input, result) : input;
  return static_cast<double>(in_flight) * (colour + others) + result;
}

FilterRun::FilterRun(const InputArguments& input, const CameraArguments& camera, const FilterArguments& filter,
                     const RunArguments& run)
    : arguments_(run),
      threads_(filter.threads > 0 ? filter.threads : tbb::info::default_concurrency()),
      kind_(parse_output_kind(run.output_kind)),
      compression_(compression_of(run)),
      shot_((check_filter_options(filter), input), camera,
            run.skip_bad_frames ? exr::BadFrames::keep : exr::BadFrames::fail),
      writer_(shot_, shot_.camera(), run.output, compression_),
      options_(filter_options(filter, shot_.facts())),
      method_(describe_method(filter.method, options_)),
      layer_of_(options_),
      stats_((writer_.prepare_folder(run.make_folder), run.stats)),
      slots_(frames_in_flight(threads_)),
      reading_(threads_) {
  const exr::Sequence& sequence = shot_.sequence();
  for (const auto& frame : sequence.frames) {
    if (!frame.problem.empty()) continue;
    shot_.camera().coc(frame.frame,
                       sequence.first);  // a camera that is not complete ends the run before it begins
    break;
  }
  if (kind_ != OutputKind::result || run.only_copy) return;
  filter_ = make_filter(parse_method(filter.method), shot_.state_window(), options_);
}

int FilterRun::run() {
  const std::size_t count = shot_.sequence().frames.size();
  progress_ = std::make_unique<Progress>(count);
  if (threads_ > 1) use_threads(threads_, kWaitingThreads);
  run_frames(count, slots_.size(), *this);
  progress_.reset();
  if (fatal_) std::rethrow_exception(fatal_);
  say_summary();
  return failed_.empty() ? kDone : kFrameFailed;
}

void FilterRun::read(std::size_t frame, std::size_t slot) {
  const exr::SequenceFrame& from = shot_.sequence().frames[frame];
  Slot& s = slots_[slot];
  if (interrupted()) throw Interrupted(from.frame);
  if (!from.problem.empty()) throw Error(ErrorCode::unreadable, from.problem);
  s.kept = arguments_.no_clobber && std::filesystem::exists(writer_.path(from.frame));
  if (s.kept) return;
  s.record = FrameRecord{from.frame, shot_.state_window(), {}, 0, 0, 0, 0};
  const Stopwatch watch;
  reading_.execute([&] { shot_.read(from, s.read, kind_ == OutputKind::result); });
  s.record.outside = s.read.outside;
  s.record.mixed = s.read.mixed;
  s.record.read_ms = watch.ms();
}

void FilterRun::filter(std::size_t frame, std::size_t slot) {
  const int number = shot_.sequence().frames[frame].frame;
  Slot& s = slots_[slot];
  if (interrupted()) throw Interrupted(number);
  if (s.kept || !filters()) return;
  s.record.stats = filter_->filter(s.read.frame, shot_.camera().coc(number, s.read.file));
  check_strictly(s);
  const Stopwatch watch;
  s.result_window = filter_->result_window();
  if (slots_.size() > 1) s.read.frame.colour = filter_->result();
  s.record.write_ms = watch.ms();
}

void FilterRun::write(std::size_t frame, std::size_t slot) {
  const int number = shot_.sequence().frames[frame].frame;
  Slot& s = slots_[slot];
  if (s.kept) {
    kept_.insert(number);
  } else {
    const Stopwatch watch;
    write_file(number, s);
    s.record.write_ms += watch.ms();
    stats_.write(s.record);
    add_to_totals(s.record);
  }
  progress_->done(number);
}

bool FilterRun::failed(std::size_t frame, std::exception_ptr error) {
  const int number = shot_.sequence().frames[frame].frame;
  fatal_ = error;
  try {
    std::rethrow_exception(error);
  } catch (const Interrupted&) {
    return false;
  } catch (const Error& e) {
    if (!arguments_.skip_bad_frames || e.code() == ErrorCode::usage) return false;
    warn(e.what());
  } catch (...) {
    return false;
  }
  fatal_ = nullptr;
  failed_.insert(number);
  progress_->done(number);
  return true;
}

void FilterRun::write_file(int frame, Slot& s) {
  if (kind_ != OutputKind::result) return writer_.write_values(frame, s.read, method_, kind_, layer_of_);
  const bool in_place = slots_.size() > 1 || !filters();
  writer_.write_colour(frame, s.read, method_, in_place ? s.read.frame.colour : filter_->result(),
                       filters() ? s.result_window : shot_.state_window(), s.scratch);
}

void FilterRun::check_strictly(const Slot& slot) const {
  if (!arguments_.strict) return;
  const Stats& s = slot.record.stats;
  if (s.repaired_colour + s.repaired_depth + s.clamped_radiance == 0) return;
  throw Error(
      ErrorCode::content,
      fmt::format("frame {}: {}: --strict: {} pixels with NaN or infinite colour, {} with an invalid depth in {}, {} "
                  "beyond --max-radiance",
                  slot.record.frame, slot.read.file.path, s.repaired_colour, s.repaired_depth,
                  slot.read.selection.depth, s.clamped_radiance));
}

void FilterRun::add_to_totals(const FrameRecord& record) {
  totals_.repaired_colour += record.stats.repaired_colour;
  totals_.repaired_depth += record.stats.repaired_depth;
  totals_.clamped_radiance += record.stats.clamped_radiance;
  totals_.clamped_coc += record.stats.clamped_coc;
  outside_ += record.outside;
  mixed_ += record.mixed;
}

void FilterRun::say_summary() const {
  const auto list = [](const std::set<int>& frames) { return exr::format_frames({frames.begin(), frames.end()}); };
  const Stats& t = totals_;
  if (t.repaired_colour + t.repaired_depth + t.clamped_radiance + t.clamped_coc > 0 || outside_ > 0) {
    warn(
        fmt::format("repaired over all frames: {} pixels with NaN or infinite colour (taken as 0), {} with an invalid "
                    "depth (taken as background), {} clamped to --max-radiance, {} clamped to --max-coc, {} outside "
                    "the picture and --overscan",
                    t.repaired_colour, t.repaired_depth, t.clamped_radiance, t.clamped_coc, outside_));
  }
  if (mixed_ > 0) warn(fmt::format("--repair-depth: {} mixed depths over all frames were replaced", mixed_));
  if (!kept_.empty()) warn(fmt::format("frames {} were there already and were kept (--no-clobber)", list(kept_)));
  if (!failed_.empty()) warn(fmt::format("frames {} failed and were skipped", list(failed_)));
}

}  // namespace pullfocus::cli
