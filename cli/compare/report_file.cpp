#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "compare/report.h"
#include "image/error.h"

namespace pullfocus::cli {

namespace fs = std::filesystem;

void check_report_path(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  std::error_code ignored;
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (fs::is_directory(path, ignored) || !fs::is_directory(folder, ignored)) {
    throw Error(ErrorCode::unwritable, fmt::format("{} {}: name a file in an existing folder", option, path));
  }
}

void write_report(const std::string& option, const std::string& path, const std::string& text) {
  if (path.empty()) return;
  const std::string temporary = fmt::format("{}.temp.{}", path, getpid());
  std::error_code problem;
  {
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file) problem = std::error_code(errno == 0 ? EIO : errno, std::generic_category());
  }
  if (!problem) fs::rename(temporary, path, problem);
  if (!problem) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw Error(ErrorCode::unwritable, fmt::format("{} {}: cannot be written: {}", option, path, problem.message()));
}

}  // namespace pullfocus::cli
