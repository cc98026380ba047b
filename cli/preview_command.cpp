#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "command.h"
#include "image/error.h"
#include "integers.h"
#include "preview/script.h"
#include "preview/window_module.h"

namespace pullfocus::cli {

Run add_preview_command(CLI::App& app) {
  struct Arguments {
    preview::PreviewArguments session;
    std::string headless, size = "1280x800";
  };
  auto a = std::make_shared<Arguments>();
  preview::PreviewArguments& session = a->session;
  add_input_options(app, session.input);
  add_camera_options(app, session.camera);
  add_picture_options(app, session.filter);
  const char* group = "Preview";
  app.add_option("--budget", session.budget,
                 "for the first picture after a change, and each better one: time, share or number")
      ->group(group)
      ->capture_default_str();
  app.add_option("--cache", session.cache_mb, "memory for frames read ahead, in MB")
      ->group(group)
      ->check(CLI::Range(1., 1e6))
      ->capture_default_str();
  app.add_option("--keys", session.keys,
                 "file to save camera keys to (default: the one of --focus @FILE, or IN.keys.toml here)")
      ->group(group)
      ->type_name("FILE");
  app.add_flag("--live", session.live, "take in frames that appear or are written again while the preview runs")
      ->group(group);
  app.add_option("-o,--out", session.out, "what the shot is exported to: folder or pattern")->group(group);
  app.add_option("--record", session.record, "write all that is done to a script")->group(group)->type_name("FILE");
  app.add_option("--headless", a->headless, "do what a script says, without a window")
      ->group(group)
      ->type_name("SCRIPT");
  app.add_option("--window-size", a->size, "WIDTHxHEIGHT")->group(group)->capture_default_str();
  app.footer([] {
    return "Actions of scripts, a line each:\n" + preview::LiveSession::help() +
           "  wait, show FILE, status, sleep MS, quit   (scripts only)\n";
  });

  return [a] {
    check_filter_options(a->session.filter);
    preview::WindowOptions window;
    if (!read_integers(a->size, "x", {&window.width, &window.height}) || window.width < 320 || window.height < 240) {
      throw Error(ErrorCode::usage, "--window-size '" + a->size + "' is not WIDTHxHEIGHT, at least 320x240");
    }
    use_threads(a->session.filter.threads, 2);
    if (!a->headless.empty()) {
      preview::LiveSession live(a->session);
      return preview::run_script(live, a->headless);
    }
    const preview::WindowModule& module = preview::window_module();  // before anything is read
    a->session.autosave = true;
    preview::LiveSession live(a->session);
    window.export_shot = a->session.out;
    window.export_file = "preview.####.exr";
    const std::string problem = module.run(live, window);
    if (!problem.empty())
      throw Error(ErrorCode::unreadable, "preview: no window: " + problem + " (--headless SCRIPT needs none)");
    return kDone;
  };
}

}  // namespace pullfocus::cli
