#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

#include "camera/keys.h"
#include "command.h"
#include "exr/range.h"
#include "image/error.h"
#include "integers.h"
#include "progress.h"
#include "render_files.h"
#include "shots_folder.h"
#include "star_lateral.h"

namespace pullfocus::cli {

namespace {

struct Arguments {
  std::string scene, output;
  std::optional<std::string> size, frames, fstop, focus;
  int samples = 16, truth = 0, views = 0;
  bool deep = false;
  int threads = 0;
};

constexpr int most_samples = 65536;

// Renders and writes one frame to DIR/NAME.####.exr, its name given without the number.
struct Job {
  std::string name;
  std::string frames;  // if none are asked for
  std::function<void(int frame, const std::string& path)> write;
};

void check_count(const char* option, int value, int low) {
  if (value < low || value > most_samples)
    throw Error(ErrorCode::usage,
                fmt::format("{} must lie between {} and {}, not {}", option, low, most_samples, value));
}

void check(const Arguments& a) {
  check_count("--samples", a.samples, 1);
  check_count("--truth", a.truth, 0);
  check_count("--truth-views", a.views, 0);
  if ((a.truth > 0) + (a.views > 0) + a.deep > 1)
    throw Error(ErrorCode::usage, "--truth, --truth-views and --deep are written one at a time: give one of them");
  if (a.threads < 0 || a.threads > 1024)
    throw Error(ErrorCode::usage, "--threads must lie between 1 and 1024, or be 0 for all processors");
}

void read_size(const Arguments& a, int& width, int& height) {
  if (!a.size) return;
  if (!read_integers(*a.size, "x", {&width, &height}) || width < 1 || height < 1 || width > 16384 || height > 16384)
    throw Error(ErrorCode::usage,
                fmt::format("--size '{}' is not WIDTHxHEIGHT in pixels, 1 to 16384 each, such as 1920x1080", *a.size));
}

Job star_job(const Arguments& a) {
  if (a.truth > 0 || a.views > 0 || a.deep || a.fstop || a.focus)
    throw Error(ErrorCode::usage, fmt::format("{} has neither truth nor deep pixels nor another lens: take fearing-1, "
                                              "the same in three dimensions",
                                              sequences::star_lateral_name));
  sequences::StarLateral scene;
  read_size(a, scene.width, scene.height);
  const auto renderer = std::make_shared<sequences::StarLateralRenderer>(scene);
  const Taken taken{sequences::star_lens(scene), sequences::star_sensor_height_mm(scene), true,
                    std::string(sequences::star_lateral_description)};
  return {a.scene, "1-100", [=, frame = std::make_shared<Frame>()](int number, const std::string& path) {
            renderer->render(number, *frame);
            write_picture_and_depth(path, taken, *frame);
          }};
}

sequences::Shot find_shot(const std::string& scene) {
  const std::string extension = std::filesystem::path(scene).extension().string();
  if (extension == ".toml" || extension == ".gltf" || extension == ".glb") return sequences::load_shot(scene);
  const std::string folder = shots_folder();
  const std::string path = sequences::shot_path(folder, scene);
  if (!path.empty()) return sequences::load_shot(path);
  throw Error(ErrorCode::usage,
              fmt::format("shot '{}' is not known: use {}, {}, or a .toml, .gltf or .glb file", scene,
                          sequences::star_lateral_name, fmt::join(sequences::shot_names(folder), ", ")));
}

Job shot_job(const Arguments& a) {
  sequences::Shot shot = find_shot(a.scene);
  read_size(a, shot.width, shot.height);
  if (a.fstop) shot.lens.fstop = KeyedValue::parse(*a.fstop, "--fstop", Infinity::refused);
  if (a.focus) shot.lens.focus = KeyedValue::parse(*a.focus, "--focus", Infinity::legal);
  if ((a.truth > 0 || a.views > 0) && !(shot.lens.fstop && shot.lens.focus))
    throw Error(ErrorCode::usage,
                fmt::format("{} says nothing of its f-number and focus: give --fstop and --focus", a.scene));
  const int width = shot.width, height = shot.height;
  const auto renderer = std::make_shared<sequences::ShotRenderer>(std::move(shot), width, height);
  const sequences::Shot& loaded = renderer->shot();
  const auto taken = [=, comment = loaded.description](int number) -> Taken {
    const sequences::FrameLens lens = renderer->lens(number);
    return {lens.lens, lens.sensor_height_mm, lens.given, comment};
  };
  Job job{loaded.name, fmt::format("{}-{}", loaded.first_frame, loaded.last_frame), {}};
  if (a.deep) {
    job.name += ".deep";
    job.write = [=, pixels = std::make_shared<sequences::DeepPixels>()](int number, const std::string& path) {
      renderer->deep(number, *pixels);
      write_deep(path, taken(number), *pixels);
    };
  } else if (a.truth > 0 || a.views > 0) {
    job.name += a.truth > 0 ? ".truth" : ".views";
    job.write = [=, image = std::make_shared<ColourImage>(), still = std::make_shared<sequences::StillPixels>()](
                    int number, const std::string& path) {
      if (a.truth > 0)
        renderer->truth(number, a.truth, *image, still.get());
      else
        renderer->truth_of_views(number, a.views, *image);
      write_truth(path, taken(number), *image);
    };
  } else {
    job.write = [=, frame = std::make_shared<Frame>(), still = std::make_shared<sequences::StillPixels>()](
                    int number, const std::string& path) {
      renderer->render(number, a.samples, *frame, still.get());
      write_picture_and_depth(path, taken(number), *frame);
    };
  }
  return job;
}

int render(const Arguments& a) {
  check(a);
  use_threads(a.threads);
  const Job job = a.scene == sequences::star_lateral_name ? star_job(a) : shot_job(a);
  const std::vector<int> frames = exr::parse_frames(a.frames.value_or(job.frames));

  std::error_code error;
  std::filesystem::create_directories(a.output, error);
  if (error) throw Error(ErrorCode::unwritable, a.output + ": cannot be created: " + error.message());

  Progress progress(frames.size());
  for (const int number : frames) {
    if (interrupted()) throw Error(ErrorCode::content, fmt::format("interrupted before frame {}", number));
    job.write(number, fmt::format("{}/{}.{:04d}.exr", a.output, job.name, number));
    progress.done(number);
  }
  return kDone;
}

}  // namespace

Run add_render_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  app.add_option("shot", a->scene, "name of a shot that comes with the program, or a .toml, .gltf or .glb file")
      ->required()
      ->type_name("SHOT");
  app.add_option("-o,--out", a->output, "folder for SHOT.####.exr; made if it is not there")->required();
  app.add_option("--size", a->size, "WIDTHxHEIGHT in pixels; default: the shot's");
  app.add_option("--frames", a->frames, "which frames; motion takes the shot's own frames; default: all of them");
  app.add_option("--samples", a->samples, "samples a pixel")->capture_default_str();
  app.add_option("--truth", a->truth, "SHOT.truth.####.exr: through the lens, with this many points of it a pixel");
  app.add_option("--truth-views", a->views, "SHOT.views.####.exr: mean of this many pinhole pictures from the lens");
  app.add_flag("--deep", a->deep, "SHOT.deep.####.exr: all surfaces along the rays through the pixel centres");
  app.add_option("--fstop", a->fstop, "f-number instead of the shot's: value or FRAME:VALUE,...");
  app.add_option("--focus", a->focus, "focus distance in metres instead of the shot's, likewise");
  app.add_option("--threads", a->threads, "number of threads; 0: one a processor")->capture_default_str();
  return [a] { return render(*a); };
}

}  // namespace pullfocus::cli
