#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "command.h"
#include "exr/range.h"
#include "exr/writer.h"
#include "image/error.h"
#include "integers.h"
#include "progress.h"
#include "star_lateral.h"

namespace pullfocus::cli {

namespace {

struct Arguments {
  std::string scene, output, size = "256x256", frames = "1-100";
  int threads = 0;
};

// Colour as half RGB, depth as float Z, and the lens in the header, so that `filter` needs no camera options
// but --lens.
void write_frame(const std::string& path, const sequences::StarLateral& scene, const Frame& frame) {
  const Window& w = frame.window();
  const ThinLens lens = sequences::star_lens(scene);
  Imf::Header header(w.width(), w.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addFocus(header, static_cast<float>(lens.focus_distance * lens.metres_per_unit));
  Imf::addAperture(header, static_cast<float>(lens.f_number));
  header.insert("nominalFocalLength", Imf::FloatAttribute(static_cast<float>(lens.focal_length_mm)));
  header.insert("sensorOverallDimensions",
                Imf::V2fAttribute(
                    {static_cast<float>(lens.sensor_mm), static_cast<float>(sequences::star_sensor_height_mm(scene))}));
  header.insert("comments", Imf::StringAttribute(std::string(sequences::star_lateral_description)));

  exr::Selection selection;
  for (const char* name : {"R", "G", "B"}) selection.colour.push_back({name, name});
  auto channels = exr::colour_channels(frame.colour, selection, w);
  channels.push_back({"Z", Imf::FLOAT, reinterpret_cast<const std::byte*>(frame.depth.row(w.y0)), sizeof(float),
                      sizeof(float) * static_cast<std::size_t>(w.width())});
  exr::write_exr(path, header, channels);
}

int render(const Arguments& a) {
  if (a.scene != sequences::star_lateral_name) {
    throw Error(ErrorCode::usage, fmt::format("scene '{}' is not known: use {} ({})", a.scene,
                                              sequences::star_lateral_name, sequences::star_lateral_description));
  }
  sequences::StarLateral scene;
  if (!read_integers(a.size, "x", {&scene.width, &scene.height}) || scene.width < 1 || scene.height < 1 ||
      scene.width > 16384 || scene.height > 16384) {
    throw Error(ErrorCode::usage,
                fmt::format("--size '{}' is not WIDTHxHEIGHT in pixels, 1 to 16384 each, such as 1920x1080", a.size));
  }
  const std::vector<int> frames = exr::parse_frames(a.frames);
  if (a.threads < 0 || a.threads > 1024) {
    throw Error(ErrorCode::usage, "--threads must lie between 1 and 1024, or be 0 for all processors");
  }
  use_threads(a.threads);

  std::error_code error;
  std::filesystem::create_directories(a.output, error);
  if (error) throw Error(ErrorCode::unwritable, a.output + ": cannot be created: " + error.message());

  const sequences::StarLateralRenderer renderer(scene);
  Frame frame;
  Progress progress(frames.size());
  for (const int number : frames) {
    if (interrupted()) throw Error(ErrorCode::content, fmt::format("interrupted before frame {}", number));
    renderer.render(number, frame);
    write_frame(fmt::format("{}/{}.{:04d}.exr", a.output, a.scene, number), scene, frame);
    progress.done(number);
  }
  return kDone;
}

}  // namespace

Run add_render_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  app.add_option("scene", a->scene,
                 fmt::format("{}: {}", sequences::star_lateral_name, sequences::star_lateral_description))
      ->required()
      ->type_name("SCENE");
  app.add_option("-o,--out", a->output, "folder for SCENE.####.exr; made if it is not there")->required();
  app.add_option("--size", a->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app.add_option("--frames", a->frames, "which frames; the motion always takes frames 1 to 100")->capture_default_str();
  app.add_option("--threads", a->threads, "number of threads; 0: one a processor")->capture_default_str();
  return [a] { return render(*a); };
}

}  // namespace pullfocus::cli
