// Scenes from glTF 2.0 files: .gltf with its buffers and pictures, or .glb.
//
// Read: meshes of triangles (lists, strips, fans) with normals, TEXCOORD_0 and COLOR_0, nodes, perspective cameras,
// animations of nodes, base colour and emission with PNG or JPEG textures, metallic and roughness factors (texture
// ignored), KHR_lights_punctual, KHR_materials_emissive_strength. All surfaces are opaque and have two sides. The
// default scene is taken, or the first.
#pragma once

#include <string>

#include "render/scene.h"

namespace pullfocus::sequences {

// Throws Error(unreadable) naming the file and what in it is damaged or not supported: skins, morph targets, sparse
// accessors, points and lines, alpha modes, orthographic cameras, texture sets but the first, required extensions but
// those above. Never reads outside the file's data, whatever it says of itself.
Scene load_gltf(const std::string& path);

}  // namespace pullfocus::sequences
