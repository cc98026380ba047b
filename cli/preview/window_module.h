// What the window's module exports. Both sides are built together; the version refuses a module of another build.
#pragma once

#include "preview/session.h"

namespace pullfocus::cli::preview {

struct WindowOptions {
  int width = 1280, height = 800;
  std::string export_file;  // what the export field begins with
  std::string export_shot;
};

struct WindowModule {
  int version;
  // Shows the window until it is closed. Empty: done; otherwise why there is none, one line. Never throws.
  std::string (*run)(Session& session, const WindowOptions& options) noexcept;
};

inline constexpr int kWindowModuleVersion = 1;
inline constexpr char kWindowModuleEntry[] =
    "pullfocus_window_module";  // const WindowModule* pullfocus_window_module()

// Loads the module. Throws Error(unreadable) saying why it cannot be used.
const WindowModule& window_module();

}  // namespace pullfocus::cli::preview
