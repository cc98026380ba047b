#include "render/shot_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>

#include "image/error.h"
#include "render/gltf.h"
#include "render/toml_values.h"

namespace pullfocus::sequences {
namespace {

constexpr int first_legal_frame = -1'000'000, last_legal_frame = 1'000'000;
constexpr float brightest = 1e6f;
constexpr float farthest = 1e6f;  // metres

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw Error(ErrorCode::unreadable, path + ": cannot be read; give a shot (.toml) or a scene (.gltf, .glb)");
  return {std::istreambuf_iterator<char>(in), {}};
}

// Entries that mean something only once the scene is there.
struct Names {
  std::optional<Entry> scene, camera, animations, hide;
};

int node_named(const Scene& scene, const Entry& entry, const std::string& name) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].name == name) return static_cast<int>(i);
  entry.refuse(fmt::format("names '{}', which is no node of the scene", name));
}

int camera_named(const Scene& scene, const Entry& entry, const std::string& name) {
  const int node = node_named(scene, entry, name);
  if (!scene.nodes[static_cast<std::size_t>(node)].is_camera)
    entry.refuse(fmt::format("names '{}', which is no camera", name));
  return node;
}

void read_cameras(const Entry& entry, Shot& shot) {
  if (entry.node.is_string()) {
    shot.cameras.push_back({0, camera_named(shot.scene, entry, entry.text())});
    return;
  }
  for (const Entry& key : entry.list()) {
    const std::vector<Entry> pair = key.list();
    if (pair.size() != 2) entry.refuse("must be a name or a list of [frame, name] keys");
    shot.cameras.push_back(
        {pair[0].whole(first_legal_frame, last_legal_frame), camera_named(shot.scene, entry, pair[1].text())});
  }
  if (shot.cameras.empty()) entry.refuse("names no camera");
  std::stable_sort(shot.cameras.begin(), shot.cameras.end(),
                   [](const CameraKey& a, const CameraKey& b) { return a.frame < b.frame; });
}

void read_animations(const Entry& entry, Shot& shot) {
  for (const std::string& name : entry.texts()) {
    const auto& all = shot.scene.animations;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Animation& a) { return a.name == name; });
    if (found == all.end()) entry.refuse(fmt::format("names '{}', which is no animation of the scene", name));
    shot.animations.push_back(static_cast<int>(found - all.begin()));
  }
}

void use_scene(const std::string& path, const Names& names, Shot& shot) {
  if (!names.scene) throw Error(ErrorCode::usage, path + ": names no scene: add a line scene = \"FILE.gltf\"");
  shot.scene = load_gltf((std::filesystem::path(path).parent_path() / names.scene->text()).string());
  const Scene& scene = shot.scene;
  if (names.camera)
    read_cameras(*names.camera, shot);
  else
    shot.cameras.push_back({0, first_camera(scene)});
  if (names.animations)
    read_animations(*names.animations, shot);
  else
    for (std::size_t i = 0; i < scene.animations.size(); ++i) shot.animations.push_back(static_cast<int>(i));
  shot.hidden.assign(scene.nodes.size(), 0);
  if (names.hide)
    for (const std::string& name : names.hide->texts())
      shot.hidden[static_cast<std::size_t>(node_named(scene, *names.hide, name))] = 1;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].parent >= 0 && shot.hidden[static_cast<std::size_t>(scene.nodes[i].parent)]) shot.hidden[i] = 1;
}

void read_lens(const Entry& entry, const std::string& file, ShotLens& lens) {
  const auto sensor = [&](bool is_height) {
    return [&lens, is_height](const Entry& e) {
      lens.sensor_mm = e.number(1e-3, 1e6);
      lens.sensor_is_height = is_height;
    };
  };
  read_table(entry, file,
             {{"focal_length", [&](const Entry& e) { lens.focal_length = e.keyed(Infinity::refused); }},
              {"fstop", [&](const Entry& e) { lens.fstop = e.keyed(Infinity::refused); }},
              {"focus", [&](const Entry& e) { lens.focus = e.keyed(Infinity::legal); }},
              {"interpolation", [&](const Entry& e) { lens.interpolation = parse_focus_interp(e.text(), e.where); }},
              {"model",
               [&](const Entry& e) {
                 if (e.text() != "render" && e.text() != "paper") e.refuse("must be \"render\" or \"paper\"");
                 lens.model = parse_lens_model(e.text());
               }},
              {"sensor_width", sensor(false)},
              {"sensor_height", sensor(true)}});
}

glm::vec3 colour(const Entry& entry) { return entry.vector(0, brightest); }

void read_light(const Entry& entry, const std::string& file, Shot& shot) {
  PlacedLight placed;
  std::optional<KeyedValue> intensity;
  read_table(entry, file,
             {{"type",
               [&](const Entry& e) {
                 if (e.text() != "directional" && e.text() != "point") e.refuse("must be \"directional\" or \"point\"");
                 placed.light.kind = e.text() == "point" ? LightKind::point : LightKind::directional;
               }},
              {"direction",
               [&](const Entry& e) {
                 const glm::vec3 direction = e.vector(-farthest, farthest);
                 if (!(glm::length(direction) > 0)) e.refuse("must not be zero");
                 placed.direction = glm::normalize(direction);
               }},
              {"position", [&](const Entry& e) { placed.position = e.vector(-farthest, farthest); }},
              {"colour", [&](const Entry& e) { placed.light.intensity = colour(e); }},
              {"intensity", [&](const Entry& e) { intensity = e.keyed(Infinity::refused); }},
              {"shadow", [&](const Entry& e) { placed.light.casts_shadow = e.flag(); }}});
  if (!intensity) entry.refuse("has no intensity");
  shot.lights.push_back({placed, *intensity});
}

Names read_shot(const toml::table& table, const std::string& file, Shot& shot) {
  Names names;
  const auto later = [](std::optional<Entry>& to) { return [&to](const Entry& e) { to.emplace(e); }; };
  read_table(table, file,
             {{"description", [&](const Entry& e) { shot.description = e.text(); }},
              {"scene", later(names.scene)},
              {"camera", later(names.camera)},
              {"animations", later(names.animations)},
              {"hide", later(names.hide)},
              {"size",
               [&](const Entry& e) {
                 const std::vector<int> size = e.wholes(2, 1, 16384);
                 shot.width = size[0];
                 shot.height = size[1];
               }},
              {"frames",
               [&](const Entry& e) {
                 const std::vector<int> frames = e.wholes(2, first_legal_frame, last_legal_frame);
                 if (frames[1] < frames[0]) e.refuse("must be [first, last]");
                 shot.first_frame = frames[0];
                 shot.last_frame = frames[1];
               }},
              {"fps", [&](const Entry& e) { shot.fps = e.number(1e-3, 1e6); }},
              {"exposure", [&](const Entry& e) { shot.exposure = e.number(-30, 30); }},
              {"noise", [&](const Entry& e) { shot.noise = e.number(0, 1); }},
              {"lens", [&](const Entry& e) { read_lens(e, file, shot.lens); }},
              {"sky",
               [&](const Entry& e) {
                 read_table(e, file,
                            {{"top", [&](const Entry& v) { shot.sky.top = colour(v); }},
                             {"horizon", [&](const Entry& v) { shot.sky.horizon = colour(v); }},
                             {"bottom", [&](const Entry& v) { shot.sky.bottom = colour(v); }}});
               }},
              {"ambient",
               [&](const Entry& e) {
                 read_table(
                     e, file,
                     {{"top", [&](const Entry& v) { shot.ambient_top = colour(v); }},
                      {"bottom", [&](const Entry& v) { shot.ambient_bottom = colour(v); }},
                      {"reach", [&](const Entry& v) { shot.ambient_reach = static_cast<float>(v.number(0, 1e6)); }}});
               }},
              {"light", [&](const Entry& e) {
                 for (const Entry& light : e.list()) read_light(light, file, shot);
               }}});
  return names;
}

}  // namespace

Shot load_shot_file(const std::string& path) {
  const std::string text = read_text(path);
  Shot shot;
  shot.name = std::filesystem::path(path).stem().string();
  try {
    const toml::table table = toml::parse(text, path);
    use_scene(path, read_shot(table, path, shot), shot);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorCode::usage,
                fmt::format("{}:{}: not TOML: {}", path, error.source().begin.line, error.description()));
  }
  return shot;
}

}  // namespace pullfocus::sequences
