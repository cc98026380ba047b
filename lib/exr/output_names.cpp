#include "exr/output_names.h"

#include <fmt/format.h>

#include <filesystem>

#include "image/error.h"

namespace pullfocus::exr {
namespace {

namespace fs = std::filesystem;

bool names_folder(std::string_view text) {
  std::error_code error;
  return text.ends_with('/') || fs::is_directory(text, error);
}

std::string resolve(std::string_view text, const Pattern& input) {
  if (!names_folder(text)) return std::string(text);
  return (fs::path(text) / fs::path(input.text()).filename()).string();
}

}  // namespace

OutputNames::OutputNames(std::string_view text, const Pattern& input, const std::vector<int>& frames)
    : pattern_(Pattern::parse(resolve(text, input))) {
  const bool own_name = !names_folder(text);
  if (own_name && pattern_.inline_range()) {
    throw Error(ErrorCode::usage, fmt::format("{}: an output takes no frame range in its name; use --frames", text));
  }
  if (pattern_.is_single() && frames.size() > 1) {
    throw Error(ErrorCode::usage, fmt::format("{}: {} frames cannot go into one file; write the frame number as ####",
                                              text, frames.size()));
  }
  std::error_code error;
  for (const int frame : frames) {
    if (!fs::equivalent(pattern_.path(frame), input.path(frame), error)) continue;
    throw Error(ErrorCode::usage, fmt::format("{}: the output would replace its own input; name another folder or file",
                                              pattern_.path(frame)));
  }
}

void OutputNames::require_folder() const {
  std::error_code error;
  const fs::file_status status = fs::status(folder(), error);
  if (!fs::exists(status)) {
    throw Error(ErrorCode::unwritable, fmt::format("{}: no such folder; create it first, or add --mkdir", folder()));
  }
  if (!fs::is_directory(status)) {
    throw Error(ErrorCode::unwritable, fmt::format("{}: is a file, not a folder", folder()));
  }
}

}  // namespace pullfocus::exr
