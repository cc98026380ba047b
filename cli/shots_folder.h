// Where the shots that come with the program are.
#pragma once

#include <string>

namespace pullfocus::cli {

// ../share/pullfocus/shots of the executable's folder, as installed, or else the source folder it was built from.
std::string shots_folder();

}  // namespace pullfocus::cli
