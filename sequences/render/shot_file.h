// Shot files; see shot.h for what they hold.
#pragma once

#include <string>

#include "render/shot.h"

namespace pullfocus::sequences {

Shot load_shot_file(const std::string& path);  // throws as load_shot()
int first_camera(const Scene& scene);          // index of a node, or -1

}  // namespace pullfocus::sequences
