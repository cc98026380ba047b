// Ambient occlusion at vertices.
#pragma once

#include "render/shading.h"

namespace pullfocus::sequences {

// Share of the cosine-weighted sky over each vertex that no surface within `reach` hides, from 32 fixed directions
// turned by the vertex's number. Meshes without normals get none (empty). Same bits for any number of threads.
std::vector<float> openness(const World& world, const PlacedMesh& mesh, float reach);

}  // namespace pullfocus::sequences
