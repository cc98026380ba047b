#include <CLI/CLI.hpp>

#include "command.h"
#include "filter_run.h"

namespace pullfocus::cli {

Run add_filter_command(CLI::App& app) {
  struct Arguments {
    InputArguments input;
    CameraArguments camera;
    FilterArguments filter;
    RunArguments run;
  };
  auto a = std::make_shared<Arguments>();
  add_input_options(app, a->input);
  add_camera_options(app, a->camera);
  add_filter_options(app, a->filter);

  const char* group = "Output";
  RunArguments& run = a->run;
  app.add_option("-o,--out", run.output, "folder, pattern, or file name for a single frame")->required()->group(group);
  app.add_option("--output", run.output_kind,
                 "result; coc: signed CoC diameters; depth: depth as understood; layer: each pixel's layer, 0 nearest")
      ->group(group)
      ->capture_default_str();
  app.add_option("--stats", run.stats, "file for one JSON line a frame; -: standard output")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--compression", run.compression,
                 "none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab (default: the input's)")
      ->group(group);
  app.add_flag("--mkdir", run.make_folder, "make the output folder if it is not there")->group(group);
  app.add_flag("--no-clobber", run.no_clobber, "keep frames that are there already")->group(group);
  app.add_flag("--skip-bad-frames", run.skip_bad_frames, "go on after a bad frame; exit code 1 at the end")
      ->group(group);
  app.add_flag("--strict", run.strict, "treat NaN, infinite and clamped values and invalid depths as errors")
      ->group(group);

  return [a] {
    check_filter_options(a->filter);  // before any thread or file
    use_threads(a->filter.threads);
    return FilterRun(a->input, a->camera, a->filter, a->run).run();
  };
}

}  // namespace pullfocus::cli
