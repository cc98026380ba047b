#include "preview/window_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "image/error.h"

namespace pullfocus::cli::preview {

const WindowModule& window_module() {
  namespace fs = std::filesystem;
  constexpr char file_name[] = "pullfocus_window.so";
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const auto refuse = [](const std::string& why) {
    throw Error(ErrorCode::unreadable, "preview: no window: " + why + " (--headless SCRIPT needs none)");
  };
  for (const char* way : {".", "../lib/pullfocus", "../../lib/pullfocus"}) {
    const fs::path file = (folder / way / file_name).lexically_normal();
    if (!fs::exists(file, ignored)) continue;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) refuse(dlerror());
    using Entry = const WindowModule* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(library, kWindowModuleEntry));
    if (entry == nullptr || entry()->version != kWindowModuleVersion) {
      refuse(file.string() + " belongs to another version of pullfocus");
    }
    return *entry();
  }
  refuse(
      fmt::format("{} is neither beside the program nor in ../lib/pullfocus: install it with the program", file_name));
  __builtin_unreachable();
}

}  // namespace pullfocus::cli::preview
