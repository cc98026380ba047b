// The filter's options as the command line gives them; shared by commands that filter or plan to.
#pragma once

#include <optional>
#include <string>

#include "filter/options.h"

namespace CLI {
class App;
}

namespace pullfocus::cli {

struct FilterArguments {
  std::string method = "incremental", visibility = "none", budget = "100%", output_type;
  double coc_step = KernelOptions{}.coc_step, max_coc = KernelOptions{}.max_coc_px;
  double w_coc = ImportanceOptions{}.w_coc, w_rgb = ImportanceOptions{}.w_rgb;
  double coc_threshold = 0, rgb_threshold = 0;
  float max_radiance = KernelOptions{}.max_radiance;
  int threads = 0;
};
void add_filter_options(CLI::App& app, FilterArguments& arguments);

enum class Method { incremental, linear };
Method parse_method(const std::string& text);  // throws Error(usage)

// Throws Error(usage). `pixel_aspect` comes from the files.
FilterOptions filter_options(const FilterArguments& arguments, double pixel_aspect);

}  // namespace pullfocus::cli
