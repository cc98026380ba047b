#include "exr/channels.h"

#include <OpenEXR/ImfMultiView.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "exr/channel_names.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

using Strings = std::vector<std::string>;
using NameMap = std::map<std::string, std::string>;  // output name -> file name

[[noreturn]] void fail(ErrorCode code, const ChannelNames& names, const std::string& message) {
  throw Error(code, fmt::format("{}: {}", names.file, message));
}

std::string pick_view(const ChannelNames& names, const ChannelOptions& options) {
  if (!options.view) return names.views.empty() ? "" : names.views.front();
  if (std::ranges::find(names.views, *options.view) != names.views.end()) return *options.view;
  fail(ErrorCode::usage, names,
       names.views.empty()
           ? fmt::format("has no views; leave out --view {}", *options.view)
           : fmt::format("has no view '{}'; --view takes one of: {}", *options.view, list_names(names.views)));
}

// Channels of the view and of no view. Where both lead to one output name, the view's own channel stays.
NameMap channels_of_view(const ChannelNames& names, const std::string& view) {
  NameMap own, shared;
  for (const std::string& name : names.channels) {
    const std::string its_view = names.views.empty() ? "" : Imf::viewFromChannelName(name, names.views);
    if (its_view.empty()) {
      shared.emplace(name, name);
    } else if (its_view == view) {
      own.emplace(Imf::removeViewName(name, view), name);
    }
  }
  own.merge(shared);
  return own;
}

bool has_channel(const NameMap& channels, std::string_view layer, std::string_view base) {
  return channels.contains(join_name(layer, base));
}

Strings colour_layers(const NameMap& channels) {
  Strings layers;
  for (const auto& [name, file_name] : channels) {
    const std::string_view layer = layer_of(name);
    if (base_of(name) == "R" && has_channel(channels, layer, "G") && has_channel(channels, layer, "B")) {
      layers.emplace_back(layer);
    }
  }
  return layers;
}

template <typename Predicate>
std::optional<std::string> only_one(const Strings& names, Predicate accept) {
  const auto first = std::ranges::find_if(names, accept);
  if (first == names.end() || std::find_if(first + 1, names.end(), accept) != names.end()) return std::nullopt;
  return *first;
}

bool is_main_layer(const std::string& layer) {
  const std::string last = lower(base_of(layer));
  return last == "combined" || last == "rgba" || last == "beauty";
}

std::string describe(const Strings& layers) {
  Strings shown = layers;
  for (std::string& layer : shown) {
    if (layer.empty()) layer = "(root)";
  }
  return list_names(shown);
}

std::string requested_layer(const ChannelNames& names, const Strings& layers, const std::string& wanted) {
  if (std::ranges::find(layers, wanted) != layers.end()) return wanted;
  const auto match = only_one(layers, [&](const std::string& layer) { return ends_in(layer, wanted); });
  if (match) return *match;
  fail(ErrorCode::usage, names,
       fmt::format("--layer {}: not exactly one layer with R, G and B; there are: {}", wanted, describe(layers)));
}

std::string pick_layer(const ChannelNames& names, const Strings& layers, const ChannelOptions& options) {
  if (layers.empty()) {
    const bool luminance = std::ranges::find(names.channels, "Y") != names.channels.end();
    fail(ErrorCode::unreadable, names,
         fmt::format("no layer has R, G and B{}; its channels are: {}",
                     luminance ? " (luminance images are not supported; convert it to RGB)" : "",
                     list_names(names.channels)));
  }
  if (options.layer) return requested_layer(names, layers, *options.layer);
  if (std::ranges::find(layers, "") != layers.end()) return "";
  if (layers.size() == 1) return layers.front();
  const auto main_layer = only_one(layers, is_main_layer);
  if (main_layer) return *main_layer;
  fail(ErrorCode::usage, names,
       fmt::format("several layers have R, G and B; choose one with --layer: {}", describe(layers)));
}

bool looks_like_depth(const NameMap& channels, const std::string& name) {
  const std::string_view layer = layer_of(name), base = base_of(name);
  if (layer.empty() && lower(base) == "depth") return true;
  if (base == "V") return lower(base_of(layer)) == "depth";
  const bool vector = has_channel(channels, layer, "X") && has_channel(channels, layer, "Y");
  return base == "Z" && !vector;
}

// Names to look for before taking any candidate, best first.
Strings preferred_depth(const std::string& layer) {
  Strings preferred = {join_name(layer, "Z")};
  for (const char* last : {"Depth.Z", "Depth.V", "depth.Z", "depth.V"}) {
    if (!layer.empty()) preferred.push_back(join_name(layer_of(layer), last));
  }
  preferred.emplace_back("Z");
  return preferred;
}

std::string requested_depth(const ChannelNames& names, const NameMap& channels, const std::string& wanted) {
  const auto in_view = channels.find(wanted);
  if (in_view != channels.end()) return in_view->second;
  if (std::ranges::find(names.channels, wanted) != names.channels.end()) return wanted;
  fail(ErrorCode::usage, names,
       fmt::format("--depth-channel {}: no such channel; there are: {}", wanted, list_names(names.channels)));
}

std::string pick_depth(const ChannelNames& names, const NameMap& channels, const std::string& layer,
                       const ChannelOptions& options) {
  if (options.depth_channel) return requested_depth(names, channels, *options.depth_channel);
  Strings candidates;
  for (const auto& [name, file_name] : channels) {
    if (looks_like_depth(channels, name)) candidates.push_back(name);
  }
  for (const std::string& name : preferred_depth(layer)) {
    if (std::ranges::find(candidates, name) != candidates.end()) return channels.at(name);
  }
  if (candidates.size() == 1) return channels.at(candidates.front());
  if (candidates.empty()) {
    fail(ErrorCode::unreadable, names,
         fmt::format("no depth channel (Z); name one with --depth-channel: {}", list_names(names.channels)));
  }
  fail(ErrorCode::usage, names,
       fmt::format("several channels may be depth; choose one with --depth-channel: {}", list_names(candidates)));
}

std::string requested_mask(const ChannelNames& names, const NameMap& channels, const std::string& wanted) {
  const auto in_view = channels.find(wanted);
  if (in_view != channels.end()) return in_view->second;
  if (std::ranges::find(names.channels, wanted) != names.channels.end()) return wanted;
  Strings candidates;
  for (const auto& [name, file_name] : channels) {
    if (ends_in(name, wanted)) candidates.push_back(name);
  }
  if (candidates.size() == 1) return channels.at(candidates.front());
  if (candidates.empty()) {
    fail(ErrorCode::usage, names,
         fmt::format("--mask {}: no such channel; there are: {}", wanted, list_names(names.channels)));
  }
  fail(ErrorCode::usage, names,
       fmt::format("--mask {}: several channels end so; give one in full: {}", wanted, list_names(candidates)));
}

}  // namespace

Selection select_channels(const ChannelNames& names, const ChannelOptions& options) {
  Selection selection;
  selection.view = pick_view(names, options);
  const NameMap channels = channels_of_view(names, selection.view);
  selection.layer = pick_layer(names, colour_layers(channels), options);
  if (!options.colour_only) selection.depth = pick_depth(names, channels, selection.layer, options);
  if (options.mask) selection.mask = requested_mask(names, channels, *options.mask);

  Strings colour_names;
  for (const char* base : {"R", "G", "B", "A"}) {
    const auto channel = channels.find(join_name(selection.layer, base));
    const bool is_depth = channel != channels.end() && channel->second == selection.depth;
    if (is_depth && *base != 'A') {
      fail(ErrorCode::usage, names, fmt::format("--depth-channel {} is the colour itself", selection.depth));
    }
    if (channel == channels.end() || is_depth) continue;
    selection.colour.push_back({channel->second, channel->first});
    colour_names.push_back(channel->first);
  }
  if (options.colour_only) return selection;
  for (const auto& [name, file_name] : channels) {
    if (std::ranges::find(colour_names, name) == colour_names.end()) selection.extra.push_back({file_name, name});
  }
  return selection;
}

}  // namespace pullfocus::exr
