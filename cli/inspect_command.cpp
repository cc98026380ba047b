#include <fmt/format.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "camera/depth_repair.h"
#include "command.h"
#include "exr/header.h"
#include "exr/range.h"
#include "filter/explain.h"
#include "filter/plan.h"
#include "filter_options.h"
#include "filter_run.h"
#include "image/error.h"
#include "scatter/disc.h"
#include "shot.h"

namespace pullfocus::cli {

namespace {

struct Arguments {
  InputArguments input;
  CameraArguments camera;
  FilterArguments filter;
  std::string explain;
};

template <typename... Values>
void say(const char* what, fmt::format_string<Values...> format, Values&&... values) {
  fmt::print("{:<14}{}\n", what, fmt::format(format, std::forward<Values>(values)...));
}

std::string window_text(const Window& w) { return fmt::format("{}x{} from {},{}", w.width(), w.height(), w.x0, w.y0); }

std::string names_of(const std::vector<exr::NamedChannel>& channels, const std::string& except) {
  std::string text;
  for (const auto& channel : channels) {
    if (channel.file_name != except) text += (text.empty() ? "" : " ") + channel.file_name;
  }
  return text.empty() ? "none" : text;
}

std::string channel_types(const exr::FileInfo& file, const std::string& channel) {
  const exr::ChannelInfo* info = file.find_channel(channel);
  return info->type == Imf::HALF ? "half" : info->type == Imf::FLOAT ? "float" : "uint";
}

void say_files(const Shot& shot, const ShotFrame& read) {
  const exr::Sequence& sequence = shot.sequence();
  say("input", "{}: frames {} ({})", sequence.pattern.text(), exr::format_frames(shot.frame_numbers()),
      sequence.frames.size());
  say("windows", "display {}; all data {}; state {}", window_text(sequence.display_window),
      window_text(sequence.data_union), window_text(shot.state_window()));
  if (read.file.pixel_aspect != 1) say("pixel aspect", "{}: kernels are elliptical", read.file.pixel_aspect);
  say("colour", "{} ({}, {}){}", names_of(read.selection.colour, ""),
      channel_types(read.file, read.selection.colour[0].file_name), exr::compression_name(read.file.compression),
      read.selection.view.empty() ? "" : ", view " + read.selection.view);
  say("passed on", "{}", names_of(read.selection.extra, ""));
}

void say_depth_edges(const Shot& shot, const ShotFrame& read) {
  if (shot.repairs_depth()) {
    say("", "{} mixed depths at edges were replaced (--repair-depth)", read.mixed);
    return;
  }
  const DepthEdges edges = find_depth_edges(read.frame, shot.camera().depth_kind());
  if (edges.look_antialiased()) {
    say("", "looks ANTIALIASED: {} pixels, {:.0f} % of its edges, lie between two surfaces and will show as rims;",
        edges.mixed, 100 * edges.share());
    say("", "render depth unfiltered (closest or first sample), or repair it with --repair-depth");
  } else if (edges.mixed + edges.sharp > 0) {
    say("", "edges are sharp: {} of {} look mixed", edges.mixed, edges.mixed + edges.sharp);
  }
}

void say_depth(const Shot& shot, const ShotFrame& read, const Plan& plan) {
  const bool planar = shot.camera().depth_kind() == DepthKind::planar;
  say("depth", "{} ({}), taken as {}", read.selection.depth, channel_types(read.file, read.selection.depth),
      planar ? "planar: distance along the camera's axis (another meaning: --depth-kind)"
             : "coc: signed CoC diameter in pixels");
  float nearest = INFINITY, farthest = -INFINITY;
  const Window& w = read.frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const float depth = read.frame.depth.at(x, y);
      if (is_background(shot.camera().depth_kind(), depth)) continue;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  const double share = 100. * static_cast<double>(plan.background) / static_cast<double>(w.pixels());
  if (nearest <= farthest) {
    say("", "surfaces from {:g} to {:g}; {:.1f} % background (no surface)", nearest, farthest, share);
  } else {
    say("", "no surface anywhere: is this the depth channel?");
  }
  say_depth_edges(shot, read);
}

void say_camera(const Shot& shot, const exr::SequenceFrame& from, const exr::FileInfo& file) {
  if (shot.camera().depth_kind() == DepthKind::coc) return say("camera", "none needed");
  const CameraSource found = shot.camera().lens(from.frame, file);
  const ThinLens& l = found.lens;
  say("camera", "{:g} mm ({}), f/{:g} ({}), focus {:g} ({})", l.focal_length_mm, found.focal_length, l.f_number,
      found.fstop, l.focus_distance, found.focus);
  say("", "sensor {:g} mm {} ({}), lens model {}, {:g} m a scene unit", l.sensor_mm, name(l.fit), found.sensor,
      name(l.model), l.metres_per_unit);
}

// What it costs at a diameter, and against the disc there.
void say_kernel(const KernelTable& kernels) {
  const KernelOptions& options = kernels.options();
  const int index = kernels.coc().index(20);
  const double diameter = kernels.coc().diameter(index), edges = kernels.kernel(index).edge_count();
  const bool turned = &kernels.kernel(-index) != &kernels.kernel(index);
  say("kernel", "{}{}", describe(options.shape), turned ? "; turned by half a turn in front of focus" : "");
  say("", "at {:g} px: {} levels, {:g} run edges a source, {:.1f} times the disc's", diameter,
      kernels.kernel(index).levels.size() - 1, edges, edges / disc_kernel(diameter, options.pixel_aspect).edge_count());
}

void say_memory(const Plan& plan, const ShotFrame& frame, const FilterOptions& options, int threads) {
  const double pixels = static_cast<double>(plan.window.pixels());
  const double frames = frame_bytes_per_pixel(frame, options.output_type, threads);
  say("", "memory: {:.0f} + {:.0f} bytes a pixel (filter + frames, {} in flight), {:.0f} MB",
      plan.state_bytes_per_pixel, frames, frames_in_flight(threads),
      pixels * (plan.state_bytes_per_pixel + frames) / 1e6);
}

void say_plan(const Plan& plan, const FilterOptions& options, const ShotFrame& frame, int threads) {
  const double pixels = static_cast<double>(plan.window.pixels());
  say("CoC", "{:.2f} to {:.2f} px (in front < 0 < behind); table indices {} to {} of {}", plan.coc_min, plan.coc_max,
      plan.index_min, plan.index_max, plan.table_size);
  if (plan.clamped_coc > 0) {
    say("", "{} pixels are beyond --max-coc {:g} and are clamped to it", plan.clamped_coc, options.kernel.max_coc_px);
  }
  if (const std::string& mask = frame.selection.mask; !mask.empty()) {
    say("mask", "{}: {} pixels ({:.2f} %) are held out", mask, plan.held_out,
        100 * static_cast<double>(plan.held_out) / pixels);
  }
  say("plan", "visibility {}; alpha {}", describe(options.visibility),
      plan.alpha ? "is filtered too" : "is 1 everywhere: not accumulated");
  for (const Plan::Layer& layer : plan.layers) {
    if (options.visibility.kind != VisibilityOptions::Kind::layers) break;
    say("", "layer {:g} to {:g} px: {:.1f} % of the sources, sums in {:.0f} % of the tiles", layer.coc_first,
        layer.coc_last, 100 * static_cast<double>(layer.pixels) / pixels, 100 * layer.reached);
  }
  if (options.visibility.kind == VisibilityOptions::Kind::bitmap) {
    say("",
        "bitmaps: in {} of {} tiles, for {:.1f} % of the pixels; elsewhere depth and CoC are too alike to hide "
        "anything",
        plan.bitmap_tiles, plan.tiles, 100 * static_cast<double>(plan.bitmap_pixels) / pixels);
  }
  say("", "linear frame: {:.1f} M run edges, {:.1f} a pixel", static_cast<double>(plan.linear_edges) / 1e6,
      static_cast<double>(plan.linear_edges) / pixels);
  say_memory(plan, frame, options, threads);
  if (!plan.changed_share) return;
  const double work = static_cast<double>(*plan.next_edges) / static_cast<double>(plan.linear_edges);
  say("next frame", "{:.2f} % of pixels change; their edges are {:.1f} % of a linear frame's",
      100 * *plan.changed_share, 100 * work);
  if (work > 0.8) {
    say("", "little will be saved: noise or a moving camera changes nearly everything, and frames are rebuilt");
  }
}

void say_explanation(const Shot& shot, const ShotFrame& read, const CocFunction& coc, const KernelTable& kernels,
                     const VisibilityOptions& visibility, const std::string& text) {
  const FocusPixel pixel = FocusPixel::parse(text);
  if (!shot.state_window().contains(pixel.x, pixel.y)) {
    throw Error(ErrorCode::usage,
                fmt::format("--explain {}: outside the state window, {}", text, window_text(shot.state_window())));
  }
  const Explanation e = explain(read.frame, coc, kernels, pixel.x, pixel.y, 8, visibility);
  say("pixel", "{},{}: depth {:g}{}; CoC {:.3f} px; index {}, kernel {:g} px wide", pixel.x, pixel.y, e.depth,
      e.background ? " (background)" : "", e.coc_px, e.index, e.diameter_px);
  say("", "colour {:g} {:g} {:g} {:g}", read.frame.colour.get(pixel.x, pixel.y, 0),
      read.frame.colour.get(pixel.x, pixel.y, 1), read.frame.colour.get(pixel.x, pixel.y, 2),
      read.frame.colour.get(pixel.x, pixel.y, 3));
  if (visibility.kind == VisibilityOptions::Kind::layers) {
    for (const LayerShare& layer : e.layers) {
      say("", "layer {:g} to {:g} px: weight {:.4f}, gives {:.2f} %", layer.coc_first, layer.coc_last, layer.weight,
          100 * layer.share);
    }
  }
  if (e.held_out) say("", "held out by the mask: it shows its own colour alone and gives none; what is lost on it:");
  if (e.filled_share > 0) {
    say("", "what is behind is hidden here: {:.2f} % are filled from where it is seen nearby", 100 * e.filled_share);
  }
  say("", "{} pixels cover it, total weight {:.4f}; its own share is {:.2f} %; the largest:", e.contributors,
      e.total_weight, 100 * e.own_share);
  for (const Contributor& c : e.largest) {
    say("", "  {:6.2f} %  from {},{}  depth {:g}{}  CoC {:.2f} px", 100 * c.share, c.x, c.y, c.depth,
        c.background ? " (background)" : "", c.coc_px);
  }
}

int inspect(const Arguments& a) {
  check_filter_options(a.filter);
  use_threads(a.filter.threads);
  const Shot shot(a.input, a.camera, exr::BadFrames::fail);
  const auto& frames = shot.sequence().frames;
  ShotFrame first;
  shot.read(frames[0], first, false);
  const FilterOptions options = filter_options(a.filter, shot.facts());
  const KernelTable kernels(options.kernel);
  say_files(shot, first);
  std::fflush(stdout);

  const CocFunction coc = shot.camera().coc(frames[0].frame, first.file);
  ShotFrame second;
  CocFunction next_coc;
  if (frames.size() > 1) {
    shot.read(frames[1], second, false);
    next_coc = shot.camera().coc(frames[1].frame, second.file);
  }
  const Plan plan =
      make_plan(options, kernels, first.frame, coc, frames.size() > 1 ? &second.frame : nullptr, next_coc);
  say_depth(shot, first, plan);
  say_camera(shot, frames[0], first.file);
  say_kernel(kernels);
  say_plan(plan, options, first, a.filter.threads > 0 ? a.filter.threads : tbb::info::default_concurrency());
  if (!a.explain.empty()) say_explanation(shot, first, coc, kernels, options.visibility, a.explain);
  return kDone;
}

}  // namespace

Run add_inspect_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  add_input_options(app, a->input);
  add_camera_options(app, a->camera);
  add_filter_options(app, a->filter);
  app.add_option("--explain", a->explain, "X,Y: tell of one pixel of the first frame: depth, CoC, who covers it")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  return [a] { return inspect(*a); };
}

}  // namespace pullfocus::cli
