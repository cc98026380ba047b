// Where the nodes of a scene are at a time.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "render/scene.h"

namespace pullfocus::sequences {

// Local to world, one matrix a node. Animations whose index is in `playing` apply, in that order; before their first
// and after their last key they hold (glTF 2.0, 3.11). time in seconds.
std::vector<glm::mat4> world_matrices(const Scene& scene, const std::vector<int>& playing, double time);

// True for nodes that one of these animations moves, themselves or through a parent.
std::vector<char> moving_nodes(const Scene& scene, const std::vector<int>& playing);

double duration(const Animation& animation);  // seconds to the last key

}  // namespace pullfocus::sequences
