#include "filter_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "image/error.h"

namespace pullfocus::cli {

void add_picture_options(CLI::App& app, FilterArguments& a) {
  const char* group = "Filter";
  app.add_option("--kernel", a.kernel.kernel,
                 "intensity distribution: disc, polygon:N (N blades, 3 to 16), gaussian, diffraction, or image:FILE")
      ->group(group)
      ->capture_default_str();
  app.add_option("--blade-rotation", a.kernel.blade_rotation,
                 "of polygon:N, anticlockwise in degrees; 0: a corner points up behind focus")
      ->group(group)
      ->capture_default_str();
  app.add_option("--blade-roundness", a.kernel.blade_roundness, "of polygon:N: 0 straight blades, 1 a disc")
      ->group(group)
      ->capture_default_str();
  app.add_option(
         "--visibility", a.visibility,
         "what lies before what: auto (layers), layers:BORDERS (CoC diameters in pixels, -2,2), bitmap[:L] (nearer "
         "pixels up to L/2 away block farther ones), none")
      ->group(group)
      ->capture_default_str();
  app.add_option("--cutoff", a.cutoff,
                 "--visibility bitmap: CoC diameters that differ by up to so many pixels never hide each other")
      ->group(group)
      ->capture_default_str();
  app.add_option("--coc-step", a.coc_step,
                 "step between CoC diameters as a share of them, half a pixel at least; 0: half a pixel")
      ->group(group);
  app.add_option("--max-coc", a.max_coc, "largest CoC diameter in pixels, 1 to 500")
      ->group(group)
      ->capture_default_str();
  app.add_option("--max-radiance", a.max_radiance, "colours are clamped to this magnitude")
      ->group(group)
      ->capture_default_str();
  app.add_option("--output-type", a.output_type, "half or float (default: as the input's colour)")->group(group);
  app.add_option("--threads", a.threads, "number of threads; 0: one a processor")->group(group)->capture_default_str();
}

void add_filter_options(CLI::App& app, FilterArguments& a) {
  add_picture_options(app, a);
  const char* group = "Filter";
  app.add_option("--method", a.method, "incremental: only what changed; linear: every frame anew; same result")
      ->group(group)
      ->capture_default_str();
  app.add_option("--budget", a.budget,
                 "share (15%) or number (200000) of changed pixels to update a frame, or time for it (40ms)")
      ->group(group)
      ->capture_default_str();
  app.add_option(
         "--order", a.order,
         "what comes first under a budget: gain (most visible error removed), fearing (weighted change) or random")
      ->group(group)
      ->capture_default_str();
  app.add_option("--w-coc", a.w_coc, "--order fearing: importance of a change of CoC, per pixel of diameter")
      ->group(group)
      ->capture_default_str();
  app.add_option("--w-rgb", a.w_rgb, "--order fearing: importance of a change of colour")
      ->group(group)
      ->capture_default_str();
  app.add_option("--buckets", a.buckets, "--order fearing: number of levels of importance")
      ->group(group)
      ->capture_default_str();
  app.add_option("--colour-distance", a.colour_distance, "for importance: rgb (linear RGB) or cieluv")
      ->group(group)
      ->capture_default_str();
  app.add_option(
         "--coc-threshold", a.coc_threshold,
         "leave changes of CoC up to so many pixels of diameter, or F/1000 (a share of the focal length), alone")
      ->group(group)
      ->capture_default_str();
  app.add_option("--rgb-threshold", a.rgb_threshold, "leave changes of colour (linear RGB) up to this alone")
      ->group(group)
      ->capture_default_str();
  app.add_option("--error-bound", a.error_bound,
                 "let every output sample differ from the exact one by so much (linear): leaves small changes alone")
      ->group(group)
      ->capture_default_str();
}

Method parse_method(const std::string& text) {
  if (text == "incremental") return Method::incremental;
  if (text == "linear") return Method::linear;
  throw Error(ErrorCode::usage, "--method '" + text + "' is not known: use incremental or linear");
}

std::unique_ptr<Filter> make_filter(Method method, const Window& state_window, const FilterOptions& options,
                                    std::shared_ptr<const KernelTable> kernels) {
  return method == Method::linear ? make_linear_filter(state_window, options, std::move(kernels))
                                  : make_incremental_filter(state_window, options, std::move(kernels));
}

namespace {

// Pixels, or "F/N": the focal length as a length on the picture, divided by N (Fearing 1996, section 4.3: F/1000).
double coc_threshold(const std::string& text, const std::optional<double>& focal_length_px) {
  const bool share = text.starts_with("F/");
  const char* begin = text.data() + (share ? 2 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto parsed = std::from_chars(begin, end, value);
  if (parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(value) || (share ? value <= 0 : value < 0)) {
    throw Error(ErrorCode::usage, "--coc-threshold '" + text + "' is neither a number of pixels, such as 0.5, nor a " +
                                      "share of the focal length, such as F/1000");
  }
  if (!share) return value;
  if (!focal_length_px) {
    throw Error(ErrorCode::usage, "--coc-threshold " + text + ": the depth is a CoC diameter, so there is no focal " +
                                      "length: give pixels");
  }
  return *focal_length_px / value;
}

}  // namespace

std::string describe_method(const std::string& method, const FilterOptions& options) {
  return fmt::format("{} kernel=\"{}\" visibility=\"{}\" coc_step={} max_coc={}", method,
                     describe(options.kernel.shape), describe(options.visibility), options.kernel.coc_step,
                     options.kernel.max_coc_px);
}

void check_filter_options(const FilterArguments& arguments) { filter_options(arguments, {1, {}, 1}); }

FilterOptions filter_options(const FilterArguments& a, const ShotFacts& facts) {
  FilterOptions options;
  options.kernel.coc_step = a.coc_step;
  options.kernel.max_coc_px = a.max_coc;
  options.kernel.pixel_aspect = facts.pixel_aspect;
  options.kernel.max_radiance = a.max_radiance;
  options.kernel.shape = kernel_shape(a.kernel);
  options.visibility = parse_visibility(a.visibility);
  options.visibility.cutoff_px = a.cutoff;
  options.importance = {parse_order(a.order), a.w_coc, a.w_rgb, a.buckets,
                        ColourMetric(parse_colour_distance(a.colour_distance), facts.chromaticities)};
  options.thresholds = {coc_threshold(a.coc_threshold, facts.focal_length_px), a.rgb_threshold};
  options.error_bound = a.error_bound;
  options.budget = Budget::parse(a.budget);
  options.threads = a.threads;
  if (a.output_type == "half") {
    options.output_type = SampleType::half;
  } else if (a.output_type == "float") {
    options.output_type = SampleType::float32;
  } else if (!a.output_type.empty()) {
    throw Error(ErrorCode::usage, "--output-type '" + a.output_type + "' is not known: use half or float");
  }
  parse_method(a.method);
  validate(options);
  return options;
}

}  // namespace pullfocus::cli
