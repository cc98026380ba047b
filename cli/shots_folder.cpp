#include "shots_folder.h"

#include <filesystem>

namespace pullfocus::cli {

std::string shots_folder() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed = program.parent_path().parent_path() / "share/pullfocus/shots";
  if (!error && std::filesystem::is_directory(installed, error)) return installed.string();
  return PULLFOCUS_SHOTS_FOLDER;
}

}  // namespace pullfocus::cli
