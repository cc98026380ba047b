// What the module exports. Both sides are built together; `kModuleVersion` refuses a module of another build.
#pragma once

#include "imageio/picture.h"

namespace pullfocus::imageio {

inline constexpr int kModuleVersion = 1;

struct Module {
  int version;
  // Empty: done; otherwise what went wrong. Never throw.
  std::string (*read)(const std::string& path, Picture& out) noexcept;
  std::string (*write)(const std::string& path, const Picture& picture) noexcept;
};

inline constexpr char kModuleEntry[] = "pullfocus_imageio_module";  // const Module* pullfocus_imageio_module()

}  // namespace pullfocus::imageio
