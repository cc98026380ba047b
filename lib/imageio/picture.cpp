#include "imageio/picture.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <system_error>

#include "image/error.h"
#include "imageio/module.h"

namespace pullfocus::imageio {

namespace fs = std::filesystem;

namespace {

constexpr char kModuleFile[] = "pullfocus_oiio.so";

// The module, or in `problem` why it cannot be used.
const Module* load(std::string& problem) {
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* way : {".", "../lib/pullfocus", "../../lib/pullfocus"}) {
    const fs::path file = (folder / way / kModuleFile).lexically_normal();
    if (!fs::exists(file, ignored)) continue;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      problem = dlerror();
      return nullptr;
    }
    using Entry = const Module* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(library, kModuleEntry));
    if (entry == nullptr || entry()->version != kModuleVersion) {
      problem = file.string() + " belongs to another version of pullfocus";
      return nullptr;
    }
    return entry();
  }
  problem =
      fmt::format("{} is neither beside the program nor in ../lib/pullfocus: install it with the program", kModuleFile);
  return nullptr;
}

const Module& module(const std::string& path, ErrorCode code) {
  struct Loaded {
    std::string problem;
    const Module* module = load(problem);
  };
  static const Loaded loaded;  // code, not state: loaded once, like any other library
  if (loaded.module == nullptr) {
    throw Error(code, fmt::format("{}: pictures need the module for OpenImageIO: {}", path, loaded.problem));
  }
  return *loaded.module;
}

}  // namespace

Picture read_picture(const std::string& path) {
  std::error_code problem;
  if (!fs::exists(path, problem)) throw Error(ErrorCode::unreadable, fmt::format("{}: no such file", path));
  if (fs::is_directory(path, problem)) throw Error(ErrorCode::unreadable, fmt::format("{}: is a folder", path));
  Picture picture;
  const std::string error = module(path, ErrorCode::unreadable).read(path, picture);
  if (!error.empty()) throw Error(ErrorCode::unreadable, fmt::format("{}: not a readable picture: {}", path, error));
  return picture;
}

void write_picture(const std::string& path, const Picture& picture) {
  const fs::path target(path);
  const fs::path temporary = target.parent_path() / fmt::format(".{}.temp.{}{}", target.stem().string(), getpid(),
                                                                target.extension().string());
  std::string error = module(path, ErrorCode::unwritable).write(temporary.string(), picture);
  std::error_code problem;
  if (error.empty()) {
    fs::rename(temporary, target, problem);
    if (problem) error = problem.message();
  }
  if (error.empty()) return;
  fs::remove(temporary, problem);
  throw Error(ErrorCode::unwritable, fmt::format("{}: cannot be written: {}", path, error));
}

}  // namespace pullfocus::imageio
