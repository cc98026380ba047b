#include "filter_run.h"

#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <filesystem>

#include "command.h"
#include "exr/range.h"
#include "exr/writer.h"
#include "filter/core.h"
#include "image/error.h"
#include "progress.h"
#include "version.h"

namespace pullfocus::cli {

OutputKind parse_output_kind(const std::string& text) {
  if (text == "result") return OutputKind::result;
  if (text == "coc") return OutputKind::coc;
  if (text == "depth") return OutputKind::depth;
  throw Error(ErrorCode::usage, "--output '" + text + "' is not known: use result, coc or depth");
}

namespace {

std::optional<Imf::Compression> compression_of(const RunArguments& run) {
  if (run.compression.empty()) return std::nullopt;
  return exr::parse_compression(run.compression);
}

// A name that does not end in .exr is a folder, there already or not.
std::string output_name(const std::string& text) {
  return text.ends_with(".exr") || text.ends_with(".EXR") || text.ends_with('/') ? text : text + '/';
}

void prepare_folder(const exr::OutputNames& names, bool make) {
  if (make) {
    std::error_code error;
    std::filesystem::create_directories(names.folder(), error);
    if (error) throw Error(ErrorCode::unwritable, names.folder() + ": cannot be created: " + error.message());
  }
  names.require_folder();
}

}  // namespace

FilterRun::FilterRun(const InputArguments& input, const CameraArguments& camera, const FilterArguments& filter,
                     const RunArguments& run)
    : arguments_(run),
      kind_(parse_output_kind(run.output_kind)),
      compression_(compression_of(run)),
      shot_((check_filter_options(filter), input), camera,
            run.skip_bad_frames ? exr::BadFrames::keep : exr::BadFrames::fail),
      names_(output_name(run.output), shot_.sequence().pattern, shot_.frame_numbers()),
      options_(filter_options(filter, shot_.facts())),
      method_(filter.method),
      stats_((prepare_folder(names_, run.make_folder), run.stats)) {
  const exr::Sequence& sequence = shot_.sequence();
  for (const auto& frame : sequence.frames) {
    if (!frame.problem.empty()) continue;
    shot_.camera().coc(frame.frame,
                       sequence.first);  // a camera that is not complete ends the run before it begins
    break;
  }
  if (kind_ != OutputKind::result) return;
  filter_ = make_filter(parse_method(method_), shot_.state_window(), options_);
}

int FilterRun::run() {
  const auto& frames = shot_.sequence().frames;
  {
    Progress progress(frames.size());
    for (const auto& frame : frames) {
      if (interrupted()) {
        throw Error(ErrorCode::content,
                    fmt::format("interrupted before frame {}: earlier frames are complete", frame.frame));
      }
      try {
        do_frame(frame);
      } catch (const Error& error) {
        if (!arguments_.skip_bad_frames || error.code() == ErrorCode::usage) throw;
        warn(error.what());
        failed_.insert(frame.frame);
      }
      progress.done(frame.frame);
    }
  }
  say_summary();
  return failed_.empty() ? kDone : kFrameFailed;
}

void FilterRun::do_frame(const exr::SequenceFrame& from) {
  if (!from.problem.empty()) throw Error(ErrorCode::unreadable, from.problem);
  if (arguments_.no_clobber && std::filesystem::exists(names_.path(from.frame))) {
    kept_.insert(from.frame);
    return;
  }
  FrameRecord record{from.frame, shot_.state_window(), {}, 0, 0, 0, 0};
  const Stopwatch read;
  shot_.read(from, current_, kind_ == OutputKind::result);
  record.outside = current_.outside;
  record.mixed = current_.mixed;
  record.read_ms = read.ms();

  if (kind_ == OutputKind::result) {
    record.stats = filter_->filter(current_.frame, shot_.camera().coc(from.frame, current_.file));
    check_strictly(record);
  }
  const Stopwatch write;
  if (kind_ == OutputKind::result) {
    write_result(from);
  } else {
    write_values(from);
  }
  record.write_ms = write.ms();
  stats_.write(record);

  totals_.repaired_colour += record.stats.repaired_colour;
  totals_.repaired_depth += record.stats.repaired_depth;
  totals_.clamped_radiance += record.stats.clamped_radiance;
  totals_.clamped_coc += record.stats.clamped_coc;
  outside_ += record.outside;
  mixed_ += record.mixed;
}

void FilterRun::check_strictly(const FrameRecord& r) const {
  if (!arguments_.strict) return;
  const Stats& s = r.stats;
  if (s.repaired_colour + s.repaired_depth + s.clamped_radiance == 0) return;
  throw Error(
      ErrorCode::content,
      fmt::format("frame {}: {}: --strict: {} pixels with NaN or infinite colour, {} with an invalid depth in {}, {} "
                  "beyond --max-radiance",
                  r.frame, current_.file.path, s.repaired_colour, s.repaired_depth, current_.selection.depth,
                  s.clamped_radiance));
}

Imf::Header FilterRun::header(const exr::SequenceFrame& from, const Window& data_window) const {
  Imf::Header header = exr::output_header(current_.file, data_window, current_.selection.view, compression_);
  const auto say = [&](const char* attribute, const std::string& text) {
    header.insert(attribute, Imf::StringAttribute(text));
  };
  say("pullfocus.version", kVersion);
  say("pullfocus.method", fmt::format("{} kernel=\"{}\" visibility=\"{}\" coc_step={} max_coc={}{}", method_,
                                      describe(options_.kernel.shape), describe(options_.visibility),
                                      options_.kernel.coc_step, options_.kernel.max_coc_px, shot_.describe(current_)));
  say("pullfocus.camera", shot_.camera().describe(from.frame, current_.file));
  return header;
}

void FilterRun::write_result(const exr::SequenceFrame& from) {
  const Window& window = filter_->result_window();
  auto channels = exr::colour_channels(filter_->result(), current_.selection, window);
  const exr::ExtraChannels extra = exr::pass_through(current_.extra, window);
  const auto more = exr::extra_channels(extra);
  channels.insert(channels.end(), more.begin(), more.end());
  exr::write_exr(names_.path(from.frame), header(from, window), channels);
}

// Signed CoC diameters in pixels as channel `CoC`, or depth as understood (background infinite) as channel
// `Z`.
void FilterRun::write_values(const exr::SequenceFrame& from) {
  const CocFunction coc = shot_.camera().coc(from.frame, current_.file);
  Plane& values = current_.frame.depth;
  const Window& w = values.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (float& value : std::span(values.row(y), static_cast<std::size_t>(w.width()))) {
      const bool background = is_background(coc.kind, value);
      if (kind_ == OutputKind::coc) {
        value = background ? coc.background() : coc(value);
      } else if (background) {
        value = background_depth(coc.kind);
      }
    }
  }
  const exr::OutputChannel channel{kind_ == OutputKind::coc ? "CoC" : "Z", Imf::FLOAT,
                                   reinterpret_cast<const std::byte*>(values.row(w.y0)), sizeof(float),
                                   sizeof(float) * static_cast<std::size_t>(w.width())};
  exr::write_exr(names_.path(from.frame), header(from, w), {channel});
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
