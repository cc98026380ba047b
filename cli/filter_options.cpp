#include "filter_options.h"

#include <CLI/CLI.hpp>

#include "image/error.h"

namespace pullfocus::cli {

void add_filter_options(CLI::App& app, FilterArguments& a) {
  const char* group = "Filter";
  app.add_option("--method", a.method, "incremental: only what changed; linear: every frame anew; same result")
      ->group(group)
      ->capture_default_str();
  app.add_option("--visibility", a.visibility, "none: plain scatter")->group(group)->capture_default_str();
  app.add_option("--budget", a.budget, "share (15%) or number (200000) of changed pixels to update a frame")
      ->group(group)
      ->capture_default_str();
  app.add_option("--w-coc", a.w_coc, "importance of a change of CoC, per pixel of diameter")
      ->group(group)
      ->capture_default_str();
  app.add_option("--w-rgb", a.w_rgb, "importance of a change of colour, linear RGB")
      ->group(group)
      ->capture_default_str();
  app.add_option("--coc-threshold", a.coc_threshold, "leave changes of CoC up to so many pixels of diameter alone")
      ->group(group)
      ->capture_default_str();
  app.add_option("--rgb-threshold", a.rgb_threshold, "leave changes of colour (linear RGB) up to this alone")
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

Method parse_method(const std::string& text) {
  if (text == "incremental") return Method::incremental;
  if (text == "linear") return Method::linear;
  throw Error(ErrorCode::usage, "--method '" + text + "' is not known: use incremental or linear");
}

FilterOptions filter_options(const FilterArguments& a, double pixel_aspect) {
  FilterOptions options;
  options.kernel = {a.coc_step, a.max_coc, pixel_aspect, a.max_radiance};
  options.importance = {a.w_coc, a.w_rgb};
  options.thresholds = {a.coc_threshold, a.rgb_threshold};
  options.budget = Budget::parse(a.budget);
  options.threads = a.threads;
  if (a.output_type == "half") {
    options.output_type = SampleType::half;
  } else if (a.output_type == "float") {
    options.output_type = SampleType::float32;
  } else if (!a.output_type.empty()) {
    throw Error(ErrorCode::usage, "--output-type '" + a.output_type + "' is not known: use half or float");
  }
  if (a.visibility != "none") {
    throw Error(ErrorCode::usage, "--visibility '" + a.visibility + "' is not known: use none");
  }
  parse_method(a.method);
  validate(options);
  return options;
}

}  // namespace pullfocus::cli
