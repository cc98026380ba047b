#include "exr/sequence.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

#include "exr/range.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

constexpr std::size_t max_gaps = 1'000'000;

// What is kept of a header; whole headers of long shots would take much memory.
struct Scanned {
  Window display_window, data_window;
  float pixel_aspect = 1;
  std::string problem;

  bool usable() const { return problem.empty(); }
};

using Scan = std::map<int, Scanned>;  // by frame

Scanned scan_file(const Pattern& pattern, int frame) {
  Scanned scanned;
  try {
    const FileInfo info = read_header(pattern.path(frame));
    scanned.display_window = info.display_window;
    scanned.data_window = info.data_window;
    scanned.pixel_aspect = info.pixel_aspect;
  } catch (const Error& error) {
    scanned.problem = fmt::format("frame {}: {}", frame, error.what());
  }
  return scanned;
}

Scan scan_files(const Pattern& pattern, const std::vector<int>& frames) {
  std::vector<Scanned> scanned(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) { scanned[i] = scan_file(pattern, frames[i]); });
  Scan scan;
  for (std::size_t i = 0; i < frames.size(); ++i) scan.emplace_hint(scan.end(), frames[i], std::move(scanned[i]));
  return scan;
}

std::vector<int> find_gaps(const std::vector<int>& sorted_frames) {
  std::vector<int> gaps;
  for (std::size_t i = 1; i < sorted_frames.size(); ++i) {
    for (std::int64_t missing = std::int64_t{sorted_frames[i - 1]} + 1; missing < sorted_frames[i]; ++missing) {
      if (gaps.size() == max_gaps) return gaps;
      gaps.push_back(static_cast<int>(missing));
    }
  }
  return gaps;
}

std::optional<std::vector<int>> requested_frames(const Pattern& pattern, std::string_view range) {
  if (!range.empty()) return parse_frames(range);
  return pattern.inline_range();
}

std::string describe(const Scanned& scanned) {
  const Window& display = scanned.display_window;
  return fmt::format("display window {},{} {}x{}, pixel aspect {}", display.x0, display.y0, display.width(),
                     display.height(), scanned.pixel_aspect);
}

// Marks every file whose geometry differs from the reference frame's; says what is wrong with the first, or
// nothing.
std::string compare_geometry(const Pattern& pattern, int reference_frame, Scan& scan) {
  const Scanned reference = scan.at(reference_frame);
  std::string first_difference;
  for (auto& [frame, scanned] : scan) {
    const bool same =
        scanned.display_window == reference.display_window && scanned.pixel_aspect == reference.pixel_aspect;
    if (same || !scanned.usable()) continue;
    scanned.problem = fmt::format("frame {}: {}: {} differs from {} of frame {}; a shot must have one display window",
                                  frame, pattern.path(frame), describe(scanned), describe(reference), reference_frame);
    if (first_difference.empty()) first_difference = scanned.problem;
  }
  return first_difference;
}

SequenceFrame make_frame(const Pattern& pattern, const Scan& scan, int frame) {
  SequenceFrame result{frame, pattern.path(frame), {}, {}};
  const auto found = scan.find(frame);
  if (found == scan.end()) {
    result.problem = fmt::format("frame {}: {}: no such file", frame, result.path);
    if (pattern.is_single()) result.problem += fmt::format(" for this frame (it is frame {})", pattern.single_frame());
  } else if (found->second.usable()) {
    result.data_window = found->second.data_window;
  } else {
    result.problem = found->second.problem;
  }
  return result;
}

std::vector<SequenceFrame> make_frames(const Pattern& pattern, const Scan& scan, const std::vector<int>& numbers) {
  std::vector<SequenceFrame> frames;
  frames.reserve(numbers.size());
  for (const int number : numbers) frames.push_back(make_frame(pattern, scan, number));
  return frames;
}

void require_good(const std::vector<SequenceFrame>& frames) {
  const auto bad = std::ranges::find_if(frames, [](const SequenceFrame& frame) { return !frame.problem.empty(); });
  if (bad != frames.end()) throw Error(ErrorCode::unreadable, bad->problem);
}

const SequenceFrame& first_usable(const std::vector<SequenceFrame>& frames) {
  const auto good = std::ranges::find_if(frames, [](const SequenceFrame& frame) { return frame.problem.empty(); });
  if (good == frames.end()) throw Error(ErrorCode::unreadable, frames.front().problem);
  return *good;
}

}  // namespace

Sequence open_sequence(const Pattern& pattern, std::string_view range, BadFrames bad_frames) {
  const auto requested = requested_frames(pattern, range);
  const std::vector<int> found = pattern.discover();
  if (found.empty() && !requested) {
    throw Error(ErrorCode::unreadable, fmt::format("{}: no file matches", pattern.text()));
  }
  const std::vector<int>& numbers = requested ? *requested : found;
  Scan scan = scan_files(pattern, found);

  Sequence sequence;
  sequence.pattern = pattern;
  if (!requested) sequence.gaps = find_gaps(found);
  sequence.frames = make_frames(pattern, scan, numbers);
  if (bad_frames == BadFrames::fail) require_good(sequence.frames);

  const SequenceFrame& reference = first_usable(sequence.frames);
  sequence.first = read_header(reference.path);
  sequence.display_window = sequence.first.display_window;
  const std::string difference = compare_geometry(pattern, reference.frame, scan);
  if (!difference.empty() && bad_frames == BadFrames::fail) throw Error(ErrorCode::unreadable, difference);
  sequence.frames = make_frames(pattern, scan, numbers);
  for (const auto& [frame, scanned] : scan) {
    if (scanned.usable()) sequence.data_union = unite(sequence.data_union, scanned.data_window);
  }
  return sequence;
}

}  // namespace pullfocus::exr
