// Camera keys in a TOML file:
//
//   interpolation = "dioptre"                 # dioptre (default), distance or smooth: of focus
//   focus = [[1, 0.4], [24, inf]]             # [frame, value] pairs, or one plain number; scene units
//   fstop = 2.8
//   focal_length = [[1, 50], [24, 85]]        # mm
//
// Every line may be missing.
#pragma once

#include <filesystem>
#include <optional>

#include "camera/keys.h"

namespace pullfocus {

struct CameraKeys {
  FocusInterp interpolation = FocusInterp::dioptre;
  std::optional<KeyedValue> focus, fstop, focal_length;
  bool operator==(const CameraKeys&) const = default;
};

// Throws Error(unreadable) if there is no such file, Error(usage) naming file and line if its text is wrong.
CameraKeys load_camera_keys(const std::filesystem::path& file);

// Loading gives back equal keys. Replaces the file in one step; throws Error(unwritable).
void save_camera_keys(const CameraKeys& keys, const std::filesystem::path& file);

}  // namespace pullfocus
