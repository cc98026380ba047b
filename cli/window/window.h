// The window itself: GLFW, OpenGL 3, Dear ImGui.
#pragma once

#include <string>

#include "preview/window_module.h"

namespace pullfocus::cli::preview {

// Runs until the window is closed. Returns why there is no window; empty: there was.
std::string run_window(Session& session, const WindowOptions& options);

}  // namespace pullfocus::cli::preview
