// A small glTF file with one of everything that is read, to be changed by tests.
#pragma once

#include <string>

namespace pullfocus::sequences::test {

struct GltfText {
  std::string json;  // names its buffer scene.bin and its picture picture.png
  std::string bin;
};
GltfText small_gltf();

// The same as .glb: the buffer in its second chunk. With embedded_picture, the picture is in the buffer as well.
std::string as_glb(const GltfText& file);
GltfText with_embedded_picture(const GltfText& file, const std::string& png);

// Writes scene.gltf, scene.bin and picture.png; returns the path of scene.gltf.
std::string write_gltf(const std::string& folder, const GltfText& file);

std::string replaced(std::string text, const std::string& from,
                     const std::string& to);  // first occurrence; must be there

}  // namespace pullfocus::sequences::test
