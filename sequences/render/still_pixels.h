// What stays from frame to frame of a shot whose camera, lens and lights stand still.
#pragma once

#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/shading.h"

namespace pullfocus::sequences {

// Pixels none of whose rays came near anything that moves in any frame of the shot: drawn again, they would have the
// same bits. A state of the caller's, for one ShotRenderer and one thread at a time; starts empty.
struct StillPixels {
  struct Setting {
    FrameCamera camera;
    Lighting lighting;
    int samples = 0;
    bool through_lens = false;
    bool operator==(const Setting&) const = default;
  };
  struct Pixel {
    glm::vec3 colour{0};
    float depth = 0;
    bool still = false;
  };

  std::optional<Setting> setting;  // that `pixels` were drawn with
  std::vector<Pixel> pixels;       // rows top down
};

}  // namespace pullfocus::sequences
