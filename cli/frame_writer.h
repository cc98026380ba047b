// Output files of `pullfocus filter`.
#pragma once

#include <optional>
#include <string>

#include "exr/header.h"
#include "exr/output_names.h"
#include "filter/options.h"
#include "scatter/layers.h"
#include "shot.h"

namespace pullfocus::cli {

enum class OutputKind { result, coc, depth, layer };
OutputKind parse_output_kind(const std::string& text);  // throws Error(usage)

// The layer that a filter with these options gives a pixel to.
class LayerOf {
 public:
  explicit LayerOf(const FilterOptions& options);
  int operator()(float coc) const noexcept { return layers_.of(table_.index(coc)); }  // of a signed diameter in pixels

 private:
  CocTable table_;
  Layers layers_;
};

class FrameWriter {
 public:
  // `camera`: what the pictures are made with. `out` as typed, `compression` unset: the input's. `shot` and `camera`
  // must live as long. Throws as exr::OutputNames.
  FrameWriter(const Shot& shot, const Camera& camera, const std::string& out,
              std::optional<Imf::Compression> compression);
  // For these frames of the shot only.
  FrameWriter(const Shot& shot, const Camera& camera, const std::string& out,
              std::optional<Imf::Compression> compression, const std::vector<int>& frames);

  void prepare_folder(bool make) const;  // throws Error(unwritable)
  std::string path(int frame) const { return names_.path(frame); }

  // `method` is what the header says of the filter. `window` of `colour` (whose window is the state window) and the
  // channels carried along; `scratch` is memory to use again. Throws as exr::write_exr().
  void write_colour(int frame, const ShotFrame& read, const std::string& method, const ColourImage& colour,
                    const Window& window, exr::ExtraChannels& scratch) const;

  // coc: signed CoC diameters in pixels as channel `CoC`; depth: depth as understood (background infinite) as channel
  // `Z`; layer: the number of each pixel's layer, the nearest one's 0, as channel `layer`. Replaces the frame's depth
  // by them.
  void write_values(int frame, ShotFrame& read, const std::string& method, OutputKind kind,
                    const LayerOf& layer_of) const;

 private:
  Imf::Header header(int frame, const ShotFrame& read, const std::string& method, const Window& data_window) const;

  const Shot& shot_;
  const Camera& camera_;
  exr::OutputNames names_;
  std::optional<Imf::Compression> compression_;
};

}  // namespace pullfocus::cli
