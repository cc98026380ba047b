#include <gtest/gtest.h>

#include "exr_files.h"
#include "gltf_files.h"
#include "render/shot.h"

namespace pullfocus::sequences::test {
namespace {

using exr::test::expect_error;
using exr::test::TempFolder;
using exr::test::write_bytes;

const std::string good = R"(description = "a square"
scene = "scene.gltf"
size = [64, 36]
frames = [5, 9]
camera = [[7, "Camera"], [1, "Camera"]]
animations = []
hide = ["Square"]
noise = 0.1
[lens]
focal_length = 35
fstop = [[5, 2], [9, 4]]
focus = [[5, 1], [9, inf]]
sensor_height = 20
[[light]]
type = "point"
position = [1, 2, 3]
colour = [1, 0.5, 0]
intensity = [[5, 1], [9, 3]]
shadow = false
)";

Shot load(const TempFolder& folder, const std::string& text) {
  write_gltf(folder.path(), small_gltf());
  write_bytes(folder / "square.toml", text);
  return load_shot(folder / "square.toml");
}

TEST(ShotFile, EveryEntryIsRead) {
  const TempFolder folder;
  const Shot shot = load(folder, good);
  EXPECT_EQ(shot.name, "square");
  EXPECT_EQ(shot.description, "a square");
  EXPECT_EQ(shot.width, 64);
  EXPECT_EQ(shot.last_frame, 9);
  EXPECT_EQ(shot.cameras.front().frame, 1);
  EXPECT_TRUE(shot.animations.empty());
  EXPECT_EQ(shot.hidden, (std::vector<char>{1, 0, 0, 1})) << "the child too";
  EXPECT_EQ(shot.noise, 0.1);
  const FrameLens lens = frame_lens(shot, 7, 64, 36);
  EXPECT_DOUBLE_EQ(lens.lens.f_number, 3);
  EXPECT_DOUBLE_EQ(lens.lens.focus_distance, 2) << "half a dioptre";
  EXPECT_DOUBLE_EQ(lens.sensor_height_mm, 20);
  EXPECT_DOUBLE_EQ(lens.lens.sensor_mm, 20.0 * 64 / 36);
  ASSERT_EQ(shot.lights.size(), 1u);
  EXPECT_EQ(shot.lights[0].light.light.kind, LightKind::point);
  EXPECT_EQ(shot.lights[0].light.light.intensity, glm::vec3(1, 0.5f, 0));
  EXPECT_DOUBLE_EQ(shot.lights[0].intensity.linear_at(7), 2);
}

TEST(ShotFile, MistakesAreNamedWithFileAndLine) {
  const TempFolder folder;
  for (const auto& [from, to, word] :
       std::vector<std::array<std::string, 3>>{{"size = [64, 36]", "size = [64]", ":3:"},
                                               {"size = [64, 36]", "size = [64, 99999999]", "16384"},
                                               {"frames = [5, 9]", "frames = [9, 5]", "[first, last]"},
                                               {"\"Camera\"", "\"Square\"", "no camera"},
                                               {"\"Camera\"", "\"Nobody\"", "Nobody"},
                                               {"animations = []", "animations = [\"fly\"]", "fly"},
                                               {"noise = 0.1", "noise = nan", "between 0 and 1"},
                                               {"noise = 0.1", "nois = 0.1", "is none of"},
                                               {"fstop = [[5, 2], [9, 4]]", "fstop = [[5, 2], [5, 4]]", "fstop"},
                                               {"fstop = [[5, 2], [9, 4]]", "fstop = -1", "fstop"},
                                               {"type = \"point\"", "type = \"round\"", "directional"},
                                               {"intensity = [[5, 1], [9, 3]]", "", "no intensity"},
                                               {"scene = \"scene.gltf\"\n", "", "names no scene"},
                                               {"[lens]", "[lens", "not TOML"}}) {
    SCOPED_TRACE(to);
    expect_error(ErrorCode::usage, {"square.toml", word}, [&] { load(folder, replaced(good, from, to)); });
  }
  expect_error(ErrorCode::unreadable, {"missing.gltf"},
               [&] { load(folder, replaced(good, "scene.gltf", "missing.gltf")); });
  expect_error(ErrorCode::unreadable, {"none.toml"}, [&] { load_shot(folder / "none.toml"); });
}

}  // namespace
}  // namespace pullfocus::sequences::test
