// Which channels of a file are colour, which one is depth, and what else is carried along.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pullfocus::exr {

// Unset fields are found by name; see select_channels().
struct ChannelOptions {
  // Colour layer: its full name, or its last components; "" is the root layer.
  std::optional<std::string> layer{};
  // One of the file's views. Default: the first one listed.
  std::optional<std::string> view{};
  // Full channel name, with or without the view's.
  std::optional<std::string> depth_channel{};
  // No depth is looked for and nothing else is carried along: for pictures that are only looked at.
  bool colour_only = false;
  // Holdout: full channel name, with or without the view's, or its last components. Default: no mask.
  std::optional<std::string> mask{};
};

// What a file holds. `file` is used in messages.
struct ChannelNames {
  std::string file;
  std::vector<std::string> channels;
  std::vector<std::string> views;  // multiView attribute, default view first; empty: no multi-view file
};

struct NamedChannel {
  std::string file_name;    // in the input file
  std::string output_name;  // the same without the view's name
  bool operator==(const NamedChannel&) const = default;
};

struct Selection {
  std::string layer;                 // colour layer, without the view's name; empty: root
  std::string view;                  // empty: not a multi-view file
  std::vector<NamedChannel> colour;  // R, G, B and, if has_alpha(), A
  std::string depth;                 // file's channel name; empty with colour_only
  std::string mask{};                // file's channel name; empty: none
  std::vector<NamedChannel> extra;   // all others of the view and of no view, depth included

  bool has_alpha() const noexcept { return colour.size() == 4; }
};

// Colour: the layer asked for, else the root layer, else the only layer with R, G and B, else the only such
// layer called Combined, rgba or beauty. Depth: the channel asked for, else `Z` of the colour layer, else
// `Depth.Z` (or `V`) beside it, else root `Z`, else the only channel that looks like depth. `Z` beside `X`
// and `Y` is a vector, not depth. A depth channel that is the colour layer's own A leaves the colour without
// alpha. Mask: the channel asked for, which may be one of the others too. Throws Error(usage) where an option is wrong
// or would decide, Error(unreadable) where the file lacks what is needed.
Selection select_channels(const ChannelNames& names, const ChannelOptions& options);

}  // namespace pullfocus::exr
