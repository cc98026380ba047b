// Texture look-up.
#pragma once

#include "render/scene.h"

namespace pullfocus::sequences {

// Bilinear, unfiltered otherwise: pixel samples do the rest. Any finite uv; others give the first texel.
glm::vec3 texture_colour(const Texture& texture, glm::vec2 uv) noexcept;

}  // namespace pullfocus::sequences
