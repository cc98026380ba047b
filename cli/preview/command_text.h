// The command that makes with `pullfocus filter` what the preview shows.
#pragma once

#include <string>
#include <vector>

#include "shot.h"

namespace pullfocus::cli::preview {

// Arguments of `pullfocus`, "filter" first: all options that are not as by default, `keys` in place of the camera's.
std::vector<std::string> filter_arguments(const InputArguments& input, const CameraArguments& camera,
                                          const CameraKeys& keys, const FilterArguments& filter,
                                          const std::string& out);

// As typed into a POSIX shell: "pullfocus" and the words, quoted where a shell would take them apart.
std::string shell_line(const std::vector<std::string>& arguments);

}  // namespace pullfocus::cli::preview
