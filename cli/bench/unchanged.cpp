// [unchanged]: frames in which nothing changes, against memory traffic alone.
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <set>

#include "bench/memory_pass.h"
#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "filter/incremental_filter.h"

namespace pullfocus::cli::bench {

namespace {

std::span<const std::byte> bytes_of(const ColourImage& image) {
  const Window& w = image.window();
  return {image.pixel(w.x0, w.y0), image.row_bytes() * static_cast<std::size_t>(w.height())};
}

void measure(int width, int height, SampleType type, int threads, int runs, Report& report) {
  const Frame frame = planes_and_floor(width, height, 20, type);
  const Window& w = frame.window();
  FilterOptions options;
  options.threads = threads;
  options.kernel.max_coc_px = 20;
  IncrementalFilter filter(w, options);
  filter.filter(frame, kDepthIsCoc);
  filter.filter(frame, kDepthIsCoc);  // from now on it knows the depths
  const Plane remembered = frame.depth;
  const std::span<const std::byte> buffers[] = {bytes_of(frame.colour), bytes_of(filter.committed().colour),
                                                std::as_bytes(std::span(frame.depth.row(w.y0), w.pixels())),
                                                std::as_bytes(std::span(remembered.row(w.y0), w.pixels()))};
  std::size_t bytes = 0;
  for (const auto& buffer : buffers) bytes += buffer.size();
  tbb::task_arena arena(threads);
  volatile std::uint64_t sink = 0;  // or the reading could be left out
  const std::vector<Times> times =
      in_turn(runs, {[&] { return filter.filter(frame, kDepthIsCoc).filter_ms; },
                     [&] { return wall_ms([&] { arena.execute([&] { sink = read_all(buffers); }); }); }});
  const double pixels = static_cast<double>(w.pixels());
  report.row({fmt::format("{}x{}", width, height), type == SampleType::half ? "half" : "float",
              fmt::format("{}", threads), fmt::format("{:g}", static_cast<double>(bytes) / pixels),
              text(ns_a_pixel(times[0], w.pixels())), text(ns_a_pixel(times[1], w.pixels())),
              text(ratio(times[0], times[1]), 2)});
}

void print(const Settings& settings, Report& report) {
  report.columns({"size", "colour", "threads", "bytes read a pixel", "unchanged frame, ns a pixel",
                  "reading alone, ns a pixel", "unchanged / reading"});
  for (const int scale : {1, 2}) {
    if (settings.quick && scale > 1) break;
    for (const SampleType type : {SampleType::half, SampleType::float32}) {
      for (const int threads : std::set{1, settings.threads_or(settings.processors)}) {
        measure(settings.quick ? 320 : 1920 * scale, settings.quick ? 180 : 1080 * scale, type, threads,
                settings.runs_or(31), report);
      }
    }
  }
  report.end();
}

}  // namespace

const Table kUnchangedTable{
    "unchanged", "Frames in which nothing changes",
    "An unchanged incremental frame with the default settings against merely reading the same bytes (colour and depth "
    "of the frame, committed colour and as many depths) with as many threads; median (range).",
    "1, and one a processor", print};

}  // namespace pullfocus::cli::bench
