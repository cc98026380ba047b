// The module's entry.
#include <exception>

#include "window/window.h"

namespace pullfocus::cli::preview {
namespace {

std::string run(Session& session, const WindowOptions& options) noexcept {
  try {
    return run_window(session, options);
  } catch (const std::exception& error) {
    return error.what();
  }
}

constexpr WindowModule kModule{kWindowModuleVersion, &run};

}  // namespace
}  // namespace pullfocus::cli::preview

extern "C" const pullfocus::cli::preview::WindowModule* pullfocus_window_module() {
  return &pullfocus::cli::preview::kModule;
}
