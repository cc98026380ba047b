// Random changes of good files: each loads or gives one error, and what loads can be rendered.
#include <gtest/gtest.h>

#include <random>

#include "exr_files.h"
#include "gltf_files.h"
#include "render/gltf.h"
#include "render/renderer.h"

namespace pullfocus::sequences::test {
namespace {

using exr::test::file_bytes;
using exr::test::TempFolder;
using exr::test::write_bytes;
using Random = std::mt19937;

constexpr const char* numbers[] = {"-1",
                                   "0",
                                   "1",
                                   "2",
                                   "7",
                                   "255",
                                   "65536",
                                   "2147483648",
                                   "4294967295",
                                   "4294967296",
                                   "18446744073709551615",
                                   "1e38",
                                   "1e308",
                                   "1e999",
                                   "-0.5",
                                   "0.1",
                                   "NaN",
                                   "null",
                                   "\"\"",
                                   "[]",
                                   "{}",
                                   "true"};

std::size_t below(Random& random, std::size_t limit) { return limit == 0 ? 0 : random() % limit; }

// Replaces one of the text's numbers.
void change_number(Random& random, std::string& text) {
  const std::size_t start = text.find_first_of("-0123456789", below(random, text.size()));
  if (start == std::string::npos) return;
  const std::size_t end = text.find_first_not_of("-0123456789.e+", start);
  text.replace(start, std::min(end, text.size()) - start, numbers[below(random, std::size(numbers))]);
}

void change_bytes(Random& random, std::string& bytes) {
  if (bytes.empty()) return;
  const std::size_t at = below(random, bytes.size()), length = 1 + below(random, 12);
  switch (random() % 5) {
    case 0:
      bytes[at] = static_cast<char>(random());
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(below(random, bytes.size()), length));
      break;
    case 3:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    default:
      bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at), "\xff\xff\xff\x7f");
  }
}

// True if it loaded.
bool load_and_render(const std::string& path) {
  try {
    const ShotRenderer renderer(load_shot(path), 6, 4);
    Frame frame;
    DeepPixels deep;
    renderer.render(2, 1, frame);
    renderer.deep(2, deep);
    return true;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()), "");
    return false;
  }
}

TEST(GltfMutation, ChangedTextLoadsOrGivesAnError) {
  const TempFolder folder;
  int loaded = 0;
  for (unsigned int seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    GltfText file = small_gltf();
    for (std::size_t i = 0; i <= seed % 3; ++i)
      if (seed % 4 == 0)
        change_bytes(random, file.json);
      else
        change_number(random, file.json);
    if (seed == 0) write_gltf(folder.path(), small_gltf());
    write_bytes(folder / "scene.gltf", file.json);
    loaded += load_and_render(folder / "scene.gltf");
  }
  EXPECT_GT(loaded, 100);
  EXPECT_LT(loaded, 1400);
}

TEST(GltfMutation, ChangedBuffersAndPicturesLoadOrGiveAnError) {
  const TempFolder folder;
  const std::string path = write_gltf(folder.path(), small_gltf());
  const std::string png = file_bytes(folder / "picture.png");
  int loaded = 0;
  for (unsigned int seed = 0; seed < 800; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::string bin = small_gltf().bin, picture = png;
    change_bytes(random, seed % 2 ? bin : picture);
    write_bytes(folder / "scene.bin", bin);
    write_bytes(folder / "picture.png", picture);
    loaded += load_and_render(path);
  }
  EXPECT_GT(loaded, 50);
}

TEST(GltfMutation, ChangedBinaryFilesLoadOrGiveAnError) {
  const TempFolder folder;
  write_gltf(folder.path(), small_gltf());
  const std::string glb = as_glb(with_embedded_picture(small_gltf(), file_bytes(folder / "picture.png")));
  int loaded = 0;
  for (unsigned int seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::string bytes = glb;
    if (seed % 3 == 0) {
      change_bytes(random, bytes);
    } else if (seed % 3 == 1) {
      std::string head = bytes.substr(0, 24);
      change_bytes(random, head);
      bytes.replace(0, 24, head);
    } else {  // numbers of the JSON, its length kept
      const std::size_t at = bytes.find_first_of("0123456789", 20 + below(random, bytes.size() - 400));
      if (at != std::string::npos) bytes[at] = static_cast<char>('0' + random() % 10);
    }
    if (seed % 50 == 0) bytes.resize(below(random, bytes.size()));
    write_bytes(folder / "scene.glb", bytes);
    loaded += load_and_render(folder / "scene.glb");
  }
  EXPECT_GT(loaded, 100);
}

}  // namespace
}  // namespace pullfocus::sequences::test
