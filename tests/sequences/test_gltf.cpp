#include "render/gltf.h"

#include <gtest/gtest.h>

#include "exr_files.h"
#include "gltf_files.h"
#include "render/pose.h"
#include "render/renderer.h"

namespace pullfocus::sequences::test {
namespace {

using exr::test::expect_error;
using exr::test::file_bytes;
using exr::test::TempFolder;
using exr::test::write_bytes;

void expect_small_scene(const Scene& scene) {
  ASSERT_EQ(scene.nodes.size(), 4u);
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.uvs[2], glm::vec2(1, 0));
  EXPECT_EQ(mesh.material.base_colour, glm::vec3(1, 1, 0.5f));
  EXPECT_EQ(mesh.material.emission, glm::vec3(0.5f, 0, 0));
  EXPECT_EQ(mesh.material.metallic, 0);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].width, 2);
  EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::repeat);
  EXPECT_EQ(scene.textures[0].texels[0], glm::vec3(1));
  EXPECT_EQ(scene.textures[0].texels[1], glm::vec3(0));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].intensity, glm::vec3(20, 10, 5));
  EXPECT_EQ(scene.animations[0].name, "move");
}

TEST(Gltf, ReadsOneOfEverything) {
  const TempFolder folder;
  expect_small_scene(load_gltf(write_gltf(folder.path(), small_gltf())));
}

TEST(Gltf, ReadsBinaryFilesWithPicturesInside) {
  const TempFolder folder;
  write_gltf(folder.path(), small_gltf());
  const std::string png = file_bytes(folder / "picture.png");
  write_bytes(folder / "scene.glb", as_glb(with_embedded_picture(small_gltf(), png)));
  expect_small_scene(load_gltf(folder / "scene.glb"));
}

TEST(Gltf, AnimatesNodesAndTheirChildren) {
  const TempFolder folder;
  const Scene scene = load_gltf(write_gltf(folder.path(), small_gltf()));
  std::size_t child = 0;
  while (scene.nodes[child].name != "Child") ++child;
  const auto at = [&](double time) { return world_matrices(scene, {0}, time)[child]; };
  EXPECT_EQ(glm::vec3(at(-1)[3]), glm::vec3(0, 0, -3));
  EXPECT_EQ(glm::vec3(at(0.25)[3]), glm::vec3(0.25f, 0, -3));
  EXPECT_EQ(glm::vec3(at(9)[3]), glm::vec3(1, 0, -3));
  EXPECT_NEAR(at(0.99)[0].x, 0.5, 1e-6);  // scaled; not yet turned: a step
  EXPECT_NEAR(at(1)[0].z, -0.5, 1e-6);
  EXPECT_EQ(moving_nodes(scene, {0}), (std::vector<char>{1, 0, 0, 1}));
}

TEST(Gltf, SceneWithoutAShotFileHasTheFieldOfViewOfItsCamera) {
  const TempFolder folder;
  const Shot shot = load_shot(write_gltf(folder.path(), small_gltf()));
  EXPECT_EQ(shot.last_frame, 25);
  const FrameLens lens = frame_lens(shot, 1, 160, 90);
  EXPECT_FALSE(lens.given);
  EXPECT_NEAR(2 * std::atan(lens.sensor_height_mm / 2 / lens.lens.focal_length_mm), 0.6, 1e-9);
  Frame frame;
  ShotRenderer(shot, 16, 9).render(1, 1, frame);
  EXPECT_NEAR(frame.depth.at(8, 4), 3, 1e-5);
  EXPECT_GT(frame.colour.get(8, 4, 0), 0.4f);
}

TEST(Gltf, StripsAndFansAreTriangles) {
  const TempFolder folder;
  for (const auto& [mode, second] :
       {std::pair{"5", std::array<std::uint32_t, 3>{1, 0, 2}}, std::pair{"6", std::array<std::uint32_t, 3>{0, 2, 0}}}) {
    GltfText file = small_gltf();
    file.json = replaced(file.json, R"("indices":3)", R"("indices":3,"mode":)" + std::string(mode));
    const Scene scene = load_gltf(write_gltf(folder.path(), file));
    EXPECT_EQ(scene.meshes[0].triangles.size(), 4u);
    EXPECT_EQ(scene.meshes[0].triangles[1], second) << mode;
  }
}

TEST(Gltf, WhatIsNotSupportedOrDamagedIsNamed) {
  struct Case {
    const char *from, *to, *word;
  };
  const TempFolder folder;
  for (
      const Case& c : {
          Case{R"("camera":0)", R"("camera":0,"skin":0)", "skins"},
          Case{R"("indices":3)", R"("indices":3,"targets":[{"POSITION":0}])", "morph targets"},
          Case{R"("indices":3)", R"("indices":3,"mode":1)", "lines"},
          Case{R"("indices":3)", R"("indices":3,"extensions":{"KHR_draco_mesh_compression":{}})", "draco"},
          Case{
              R"("count":4,"type":"VEC2")",
              R"("count":4,"sparse":{"count":1,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}},"type":"VEC2")",
              "sparse"},
          Case{R"("scene":0)", R"("extensionsRequired":["EXT_texture_webp"],"scene":0)", "EXT_texture_webp"},
          Case{R"("emissiveFactor")", R"("alphaMode":"BLEND","emissiveFactor")", "BLEND"},
          Case{R"({"index":0})", R"({"index":0,"texCoord":1})", "TEXCOORD_1"},
          Case{R"({"index":0})", R"({"index":0,"extensions":{"KHR_texture_transform":{}}})", "KHR_texture_transform"},
          Case{R"("path":"rotation")", R"("path":"weights")", "weights"},
          Case{R"("type":"perspective","perspective":{"yfov":0.6,"znear":0.1})",
               R"("type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":2,"znear":1})", "perspective"},
          Case{R"("mesh":0)", R"("mesh":0,"children":[0])", "ancestor"},
          Case{R"("nodes":[0,2,3])", R"("nodes":[0,1])", "two parents"},
          Case{R"("nodes":[0,2,3])", R"("nodes":[0,77])", "node 77"},
          Case{R"("count":6)", R"("count":4000000000)", "beyond its buffer view"},
          Case{R"("byteOffset":172)", R"("byteOffset":18446744073709551000)", "scene.gltf"},
          Case{R"("yfov":0.6)", R"("yfov":1e400)", "scene.gltf"},
          Case{R"([0,0,-3])", R"([0,0,1e30])", "translation"},
          Case{"picture.png", "missing.png", "missing.png"},
          Case{R"("asset":{"version":"2.0"})", R"("asset":{"version":"2.0","extras":)", "scene.gltf"},
      }) {
    GltfText file = small_gltf();
    file.json = replaced(file.json, c.from, c.to);
    const std::string path = write_gltf(folder.path(), file);
    SCOPED_TRACE(c.to);
    expect_error(ErrorCode::unreadable, {"scene.gltf", c.word}, [&] { load_gltf(path); });
  }
  expect_error(ErrorCode::unreadable, {"nothing.gltf"}, [&] { load_gltf(folder / "nothing.gltf"); });
}

TEST(Gltf, NumbersThatAreNotFiniteAndIndicesBeyondTheVerticesAreRefused) {
  const TempFolder folder;
  GltfText file = small_gltf();
  file.bin.replace(8, 4, std::string("\0\0\xc0\x7f", 4));  // NaN
  expect_error(ErrorCode::unreadable, {"NaN"}, [&] { load_gltf(write_gltf(folder.path(), file)); });
  file = small_gltf();
  file.bin[130] = 4;
  expect_error(ErrorCode::unreadable, {"index 4"}, [&] { load_gltf(write_gltf(folder.path(), file)); });
}

TEST(Gltf, DeeplyNestedTextIsRefusedBeforeItIsParsed) {
  const TempFolder folder;
  write_bytes(folder / "deep.gltf", R"({"extras":)" + std::string(200000, '[') + std::string(200000, ']') + "}");
  expect_error(ErrorCode::unreadable, {"deep.gltf", "nested"}, [&] { load_gltf(folder / "deep.gltf"); });
}

}  // namespace
}  // namespace pullfocus::sequences::test
