#include "frame_writer.h"

#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <filesystem>

#include "exr/writer.h"
#include "image/error.h"
#include "version.h"

namespace pullfocus::cli {

OutputKind parse_output_kind(const std::string& text) {
  if (text == "result") return OutputKind::result;
  if (text == "coc") return OutputKind::coc;
  if (text == "depth") return OutputKind::depth;
  throw Error(ErrorCode::usage, "--output '" + text + "' is not known: use result, coc or depth");
}

namespace {

// A name that does not end in .exr is a folder, there already or not.
std::string output_name(const std::string& text) {
  return text.ends_with(".exr") || text.ends_with(".EXR") || text.ends_with('/') ? text : text + '/';
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

void FrameWriter::write_values(int frame, ShotFrame& read, const std::string& method, OutputKind kind) const {
  const CocFunction coc = camera_.coc(frame, read.file);
  Plane& values = read.frame.depth;
  const Window& w = values.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (float& value : std::span(values.row(y), static_cast<std::size_t>(w.width()))) {
      const bool background = is_background(coc.kind, value);
      if (kind == OutputKind::coc) {
        value = background ? coc.background() : coc(value);
      } else if (background) {
        value = background_depth(coc.kind);
      }
    }
  }
  const exr::OutputChannel channel{kind == OutputKind::coc ? "CoC" : "Z", Imf::FLOAT,
                                   reinterpret_cast<const std::byte*>(values.row(w.y0)), sizeof(float),
                                   sizeof(float) * static_cast<std::size_t>(w.width())};
  exr::write_exr(names_.path(frame), header(frame, read, method, w), {channel});
}

}  // namespace pullfocus::cli
