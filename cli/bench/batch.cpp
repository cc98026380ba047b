// [batch]: what filtering adds to a batch run that reads and writes EXR files.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <vector>

#include "bench/table.h"
#include "bench/timing.h"
#include "command.h"
#include "filter/core.h"
#include "filter_run.h"
#include "image/error.h"
#include "render_files.h"
#include "star_lateral.h"

namespace pullfocus::cli::bench {

namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "pullfocus_batch_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw Error(ErrorCode::unwritable, "no temporary folder can be made");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

// Noise of its own in every frame, as a path tracer leaves it: every pixel changes, and files compress badly.
void add_grain(Frame& frame, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> grain(1, 0.02f);
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, frame.colour.get(x, y, c) * grain(random));
    }
  }
}

struct BatchShot {
  const char* name;
  const char* description;
  bool grain;
  const char* focus;  // options, or empty: the header's
  const char* fstop;
};

// CoC diameters up to 270 px at f/3.5, 68 px at f/14.
constexpr BatchShot kShots[] = {
    {"star", "only the star moves, f/3.5", false, "", ""},
    {"star 14", "the same, f/14", false, "", "14"},
    {"pull", "the same, f/14, focus from 40 to 48 mm in 100 frames", false, "1:0.04,100:0.048", "14"},
    {"grain", "noise of its own in every frame, f/14", true, "", "14"}};

constexpr int kFirst = 40;

void write_shot(const std::string& folder, bool grain, int width, int height, int frames) {
  fs::create_directory(folder);
  const sequences::StarLateral scene{width, height};
  const sequences::StarLateralRenderer renderer(scene);
  Taken taken{sequences::star_lens(scene), sequences::star_sensor_height_mm(scene), true, ""};
  Frame frame;
  for (int i = kFirst; i < kFirst + frames; ++i) {
    renderer.render(i, frame);
    if (grain) add_grain(frame, static_cast<unsigned>(i));
    write_picture_and_depth(fmt::format("{}/shot.{:04d}.exr", folder, i), taken, frame);
  }
}

std::uintmax_t bytes_in(const std::string& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
  return bytes;
}

struct Cost {
  double wall_ms, processor_ms;  // elapsed; of all threads
};

double processor_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) / 1e3;
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

Cost run(const BatchShot& shot, const std::string& in, const std::string& out, int threads, bool only_copy) {
  InputArguments input;
  input.input = in + "/shot.####.exr";
  CameraArguments camera;
  camera.lens = "paper";
  if (*shot.focus != '\0') camera.focus = shot.focus;
  if (*shot.fstop != '\0') camera.fstop = shot.fstop;
  FilterArguments filter;
  filter.threads = threads;
  RunArguments arguments;
  arguments.output = out;
  arguments.make_folder = true;
  arguments.only_copy = only_copy;
  use_threads(threads);
  const double before = processor_ms();
  const Stopwatch watch;
  try {
    if (FilterRun(input, camera, filter, arguments).run() != kDone)
      throw Error(ErrorCode::content, "a frame of the benchmark failed");
  } catch (const Error&) {
    if (interrupted()) throw Interrupted{};  // a run that was cut short is no row
    throw;
  }
  return {watch.ms(), processor_ms() - before};
}

void print(const Settings& settings, Report& report) {
  const int width = settings.quick ? 160 : 1920, height = settings.quick ? 90 : 1080, frames = settings.quick ? 3 : 24;
  const int threads = settings.threads_or(settings.quick ? 2 : settings.processors);
  const Folder folder;
  report.columns({"shot", "filter / read and write only", "processor time, ratio", "read and write only, ms a frame",
                  "MB a frame in, out"});
  for (const BatchShot& shot : kShots) {
    const std::string in = folder / (shot.grain ? "grain" : "plain");
    if (!fs::exists(in)) write_shot(in, shot.grain, width, height, frames);
    Times wall, processor, plain_ms;
    const auto round = [&] {
      const Cost plain = run(shot, in, folder / "copy", threads, true);
      const Cost filtered = run(shot, in, folder / "out", threads, false);
      wall.push_back(filtered.wall_ms / plain.wall_ms);
      processor.push_back(filtered.processor_ms / plain.processor_ms);
      plain_ms.push_back(plain.wall_ms / frames);
    };
    round();  // warms up
    wall.clear(), processor.clear(), plain_ms.clear();
    for (int i = 0; i < settings.runs_or(7); ++i) round();
    const auto mb = [&](const std::string& of) { return static_cast<double>(bytes_in(of)) / frames / 1e6; };
    report.row({fmt::format("{}: {}", shot.name, shot.description), text(spread(wall), 2), text(spread(processor), 2),
                fmt::format("{:.0f}", median(plain_ms)), fmt::format("{:.1f}, {:.1f}", mb(in), mb(folder / "out"))});
  }
  report.end();
}

}  // namespace

const Table kBatchTable{
    "batch", "Batch",
    "`pullfocus filter` over 24 frames of `star-lateral`, 1920x1080, half RGB + float Z, ZIP, against the same "
    "pipeline without the filter, which only reads and writes the frames; median (range) of ratios of elapsed and of "
    "processor time. The first frame is a full one, in memory that nobody has touched yet.",
    "one a processor", print};

}  // namespace pullfocus::cli::bench
