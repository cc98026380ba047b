// The filter's options as the command line gives them; shared by commands that filter or plan to.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "filter/filter.h"
#include "filter/options.h"
#include "kernel_arguments.h"

namespace CLI {
class App;
}

namespace pullfocus::cli {

struct FilterArguments {
  std::string method = "incremental", visibility = "auto", budget = "100%", output_type;
  std::string order{name(Order::gain)}, colour_distance{name(ColourDistance::rgb)}, coc_threshold = "0";
  KernelArguments kernel;
  double coc_step = KernelOptions{}.coc_step, max_coc = KernelOptions{}.max_coc_px;
  double w_coc = ImportanceOptions{}.w_coc, w_rgb = ImportanceOptions{}.w_rgb;
  int buckets = ImportanceOptions{}.buckets;
  double cutoff = VisibilityOptions{}.cutoff_px, rgb_threshold = 0, error_bound = 0;
  float max_radiance = KernelOptions{}.max_radiance;
  int threads = 0;
};
// Those that the exact picture depends on, and --threads; and all of them.
void add_picture_options(CLI::App& app, FilterArguments& arguments);
void add_filter_options(CLI::App& app, FilterArguments& arguments);

enum class Method { incremental, linear };
Method parse_method(const std::string& text);  // throws Error(usage)

// The filter of a method.
std::unique_ptr<Filter> make_filter(Method method, const Window& state_window, const FilterOptions& options,
                                    std::shared_ptr<const KernelTable> kernels = nullptr);

// What the options depend on beside themselves.
struct ShotFacts {
  double pixel_aspect = 1;
  Chromaticities chromaticities;
  std::optional<double> focal_length_px;  // of the first frame, as a length on the picture; unset: there is no lens
};

// Throws Error(usage).
FilterOptions filter_options(const FilterArguments& arguments, const ShotFacts& facts);

// Method and settings in one line, for the headers of output files.
std::string describe_method(const std::string& method, const FilterOptions& options);

// Throws what filter_options() throws of the options alone: before any file is touched.
void check_filter_options(const FilterArguments& arguments);

}  // namespace pullfocus::cli
