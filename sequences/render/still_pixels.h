// What stays from frame to frame of a shot whose camera, lens and lights stand still.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/shading.h"

namespace pullfocus::sequences {

// Pixels as they are where nothing that moves comes near their rays: drawn again, they would have the same bits. Kept
// with the spans of frames in which something does come near. A state of the caller's, for one ShotRenderer and one
// thread at a time; starts empty.
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
    std::uint32_t touched = 0;  // spans of frames
    bool known = false;
    std::uint8_t tries = 0;  // that ended with something near
  };

  std::optional<Setting> setting;  // that `pixels` were drawn with
  std::vector<Pixel> pixels;       // rows top down
};

}  // namespace pullfocus::sequences
