#include "frame_writer.h"

#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "exr/writer.h"
#include "image/error.h"
#include "version.h"

namespace pullfocus::cli {

OutputKind parse_output_kind(const std::string& text) {
  if (text == "result") return OutputKind::result;
  if (text == "coc") return OutputKind::coc;
  if (text == "depth") return OutputKind::depth;
  if (text == "layer") return OutputKind::layer;
  throw Error(ErrorCode::usage, "--output '" + text + "' is not known: use result, coc, depth or layer");
}

LayerOf::LayerOf(const FilterOptions& options)
    : table_(options.kernel.coc_step, options.kernel.max_coc_px, options.kernel.smallest_step),
      layers_(table_, layer_borders(options.visibility)) {}

namespace {

// A name that does not end in .exr is a folder, there already or not.
std::string output_name(const std::string& text) {
  return text.ends_with(".exr") || text.ends_with(".EXR") || text.ends_with('/') ? text : text + '/';
}

const char* channel_of(OutputKind kind) {
  if (kind == OutputKind::coc) return "CoC";
  return kind == OutputKind::layer ? "layer" : "Z";
}

}  // namespace

FrameWriter::FrameWriter(const Shot& shot, const Camera& camera, const std::string& out,
                         std::optional<Imf::Compression> compression)
    : FrameWriter(shot, camera, out, compression, shot.frame_numbers()) {}

FrameWriter::FrameWriter(const Shot& shot, const Camera& camera, const std::string& out,
                         std::optional<Imf::Compression> compression, const std::vector<int>& frames)
    : shot_(shot),
      camera_(camera),
      names_(output_name(out), shot.sequence().pattern, frames),
      compression_(compression) {}

void FrameWriter::prepare_folder(bool make) const {
  if (make) {
    std::error_code error;
    std::filesystem::create_directories(names_.folder(), error);
    if (error) throw Error(ErrorCode::unwritable, names_.folder() + ": cannot be created: " + error.message());
  }
  names_.require_folder();
}

Imf::Header FrameWriter::header(int frame, const ShotFrame& read, const std::string& method,
                                const Window& data_window) const {
  Imf::Header header = exr::output_header(read.file, data_window, read.selection.view, compression_);
  const auto say = [&](const char* attribute, const std::string& text) {
    header.insert(attribute, Imf::StringAttribute(text));
  };
  say("pullfocus.version", kVersion);
  say("pullfocus.method", method + shot_.describe(read));
  say("pullfocus.camera", camera_.describe(frame, read.file));
  return header;
}

void FrameWriter::write_colour(int frame, const ShotFrame& read, const std::string& method, const ColourImage& colour,
                               const Window& window, exr::ExtraChannels& scratch) const {
  auto channels = exr::colour_channels(colour, read.selection, window);
  const auto more = exr::extra_channels(exr::pass_through(read.extra, window, scratch));
  channels.insert(channels.end(), more.begin(), more.end());
  exr::write_exr(names_.path(frame), header(frame, read, method, window), channels);
}

void FrameWriter::write_values(int frame, ShotFrame& read, const std::string& method, OutputKind kind,
                               const LayerOf& layer_of) const {
  const CocFunction coc = camera_.coc(frame, read.file);
  const auto value_of = [&](float depth) {
    const bool background = is_background(coc.kind, depth);
    if (kind == OutputKind::depth) return background ? background_depth(coc.kind) : depth;
    const float diameter = background ? coc.background() : coc(depth);
    return kind == OutputKind::layer ? static_cast<float>(layer_of(diameter)) : diameter;
  };
  Plane& values = read.frame.depth;
  const Window& w = values.window();
  for (int y = w.y0; y < w.y1; ++y) {
    const std::span row(values.row(y), static_cast<std::size_t>(w.width()));
    std::transform(row.begin(), row.end(), row.begin(), value_of);
  }
  const exr::OutputChannel channel{channel_of(kind), Imf::FLOAT, reinterpret_cast<const std::byte*>(values.row(w.y0)),
                                   sizeof(float), sizeof(float) * static_cast<std::size_t>(w.width())};
  exr::write_exr(names_.path(frame), header(frame, read, method, w), {channel});
}

}  // namespace pullfocus::cli
