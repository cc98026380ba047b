// The things of a shot where they stand in one frame. `world`: a matrix a node.
#pragma once

#include <vector>

#include "render/intersector.h"
#include "render/shading.h"
#include "render/shot.h"

namespace pullfocus::sequences {

Box box_of(const std::vector<PlacedMesh>& meshes);

// Meshes of the nodes whose flag in `moves` is `moving`.
std::vector<PlacedMesh> place(const Shot& shot, const std::vector<char>& moves, bool moving,
                              const std::vector<glm::mat4>& world);

std::vector<PlacedLight> place_lights(const Shot& shot, int frame, const std::vector<glm::mat4>& world);

// Of the moving nodes' meshes; of the first 1000 frames.
Reach reach_of_moving(const Shot& shot, const std::vector<char>& moves);
int span_of(const Shot& shot, int frame) noexcept;  // index into Reach::spans, for frames of the shot

// Stands in front of everything, for scenes without a camera.
glm::mat4 outside(const Box& box, double vertical_fov);

}  // namespace pullfocus::sequences
