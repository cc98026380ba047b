// A shot: a scene, the frames of it, and the camera and light it is taken with. As a file, TOML:
//
//   description = "what is to be seen"
//   scene = "../scenes/desk.gltf"        # beside the shot file
//   size = [480, 270]                    # pixels
//   frames = [1, 100]                    # first and last
//   fps = 24                             # frames a second of the scene's animations; the first frame is second 0
//   camera = "Camera"                    # name of a node, or keys [[1, "A"], [25, "B"]]: a cut; default: the first
//   animations = ["lateral"]             # which of the scene's play; default: all
//   hide = ["Star"]                      # nodes, with all below them
//   exposure = 0                         # stops
//   noise = 0                            # standard deviation of a new random factor a pixel and frame, RGB only
//
//   [lens]
//   focal_length = 8                     # mm; value or [frame, value] keys, as all numbers here
//   fstop = 3.5
//   focus = [[1, 0.02], [100, 0.2]]      # metres, inf
//   interpolation = "dioptre"            # of focus: dioptre, distance, smooth
//   sensor_width = 36                    # mm; or sensor_height
//   model = "render"                     # render: image distance F; paper: 1/(1/F - 1/P), which breathes
//
//   [sky]                                # radiance at infinity: black if missing
//   top = [0.2, 0.3, 0.5]
//   horizon = [0.6, 0.6, 0.6]
//   bottom = [0.1, 0.1, 0.1]
//
//   [ambient]                            # light from all sides
//   top = [0.4, 0.4, 0.5]
//   bottom = [0.2, 0.2, 0.2]
//   reach = 0.05                         # metres: things nearer than this dim it; 0: nothing does
//
//   [[light]]                            # beside those of the scene
//   type = "directional"                 # or point
//   direction = [-0.3, -1, -0.4]         # position = [x, y, z] of a point light
//   colour = [1, 0.9, 0.8]
//   intensity = [[1, 3], [50, 0.5]]      # lux, or candela of point lights
//   shadow = true
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/keys.h"
#include "camera/thin_lens.h"
#include "render/shading.h"

namespace pullfocus::sequences {

struct CameraKey {
  int frame = 0;
  int node = -1;  // index into Scene::nodes; -1: a camera in front of everything
};

struct KeyedLight {
  PlacedLight light;  // of intensity 1
  KeyedValue intensity;
};

struct ShotLens {
  std::optional<KeyedValue> focal_length;  // mm; empty: from the camera's field of view
  std::optional<KeyedValue> fstop, focus;  // focus in metres; a shot that only shows everything sharp has neither
  FocusInterp interpolation = FocusInterp::dioptre;
  LensModel model = LensModel::render;
  double sensor_mm = 36;          // > 0
  bool sensor_is_height = false;  // of which sensor_mm is the length
};

struct Shot {
  std::string name, description;
  Scene scene;
  int width = 480, height = 270;  // pixels, 1 .. 16384
  int first_frame = 1, last_frame = 1;
  double fps = 24;
  std::vector<CameraKey> cameras;  // by frame, at least one; the first also holds before its frame
  std::vector<int> animations;     // indices into Scene::animations
  std::vector<char> hidden;        // a flag a node
  ShotLens lens;
  Sky sky;
  glm::vec3 ambient_top{0}, ambient_bottom{0};
  float ambient_reach = 0;  // metres
  std::vector<KeyedLight> lights;
  double exposure = 0;  // stops
  double noise = 0;     // 0 .. 1
};

// A shot file (.toml) or a glTF scene (.gltf, .glb), which becomes a shot with plain light, if it has none of its own,
// from its first camera, over the length of its animations. Throws Error(usage) naming the shot file, line and entry,
// or Error(unreadable) naming the file.
Shot load_shot(const std::string& path);

// The shots that come with the program, from the folder they are in.
std::vector<std::string> shot_names(const std::string& folder);
std::string shot_path(const std::string& folder, std::string_view name);  // empty: no such shot

// Lens of a frame at a picture size. Where the shot has no f-number or focus, `given` is false and the lens is that of
// a pinhole: f/1e6, focus at infinity.
struct FrameLens {
  ThinLens lens;
  double sensor_height_mm = 0;
  bool given = true;
};
FrameLens frame_lens(const Shot& shot, int frame, int width, int height);

int camera_node(const Shot& shot, int frame);
double frame_time(const Shot& shot, int frame);  // seconds

}  // namespace pullfocus::sequences
