#include "preview/command_text.h"

#include <fmt/format.h>

#include <type_traits>

namespace pullfocus::cli::preview {

std::vector<std::string> filter_arguments(const InputArguments& input, const CameraArguments& camera,
                                          const CameraKeys& keys, const FilterArguments& filter,
                                          const std::string& out) {
  std::vector<std::string> words{"filter", input.input, "--out", out};
  const auto say = [&](const char* option, const auto& value) {
    words.push_back(fmt::format("{}={}", option, value));  // one word, so that a value may begin with a dash
  };
  const auto say_given = [&](const char* option, const auto& value) {
    if (value) say(option, *value);
  };
  const auto say_changed = [&](const char* option, const auto& value, const auto& usual) {
    if (value != usual) say(option, value);
  };
  const InputArguments usual_input;
  say_given("--frames", input.frames);
  say_given("--layer", input.layer);
  say_given("--view", input.view);
  say_given("--depth-channel", input.depth_channel);
  say_given("--mask", input.mask);
  say_changed("--overscan", input.overscan, usual_input.overscan);
  if (input.repair_depth) words.push_back("--repair-depth");

  const CameraArguments usual_camera;
  if (keys.focus) {
    say("--focus", keys.focus->to_string());
    if (!keys.focus->is_constant()) say("--focus-interp", name(keys.interpolation));
  }
  if (keys.fstop) say("--fstop", keys.fstop->to_string());
  if (keys.focal_length) say("--focal-length", keys.focal_length->to_string());
  say_changed("--lens", camera.lens, usual_camera.lens);
  say_given("--sensor-width", camera.sensor_width);
  say_changed("--sensor-fit", camera.sensor_fit, usual_camera.sensor_fit);
  say_changed("--unit", camera.unit, usual_camera.unit);
  say_changed("--near-scale", camera.near_scale, usual_camera.near_scale);
  say_changed("--far-scale", camera.far_scale, usual_camera.far_scale);
  say_changed("--depth-kind", camera.depth_kind, usual_camera.depth_kind);

  const FilterArguments usual;
  say_changed("--kernel", filter.kernel.kernel, usual.kernel.kernel);
  say_changed("--blade-rotation", filter.kernel.blade_rotation, usual.kernel.blade_rotation);
  say_changed("--blade-roundness", filter.kernel.blade_roundness, usual.kernel.blade_roundness);
  say_changed("--visibility", filter.visibility, usual.visibility);
  say_changed("--cutoff", filter.cutoff, usual.cutoff);
  say_changed("--coc-step", filter.coc_step, usual.coc_step);
  say_changed("--max-coc", filter.max_coc, usual.max_coc);
  say_changed("--max-radiance", filter.max_radiance, usual.max_radiance);
  say_changed("--output-type", filter.output_type, usual.output_type);
  say_changed("--threads", filter.threads, usual.threads);
  return words;
}

std::string shell_line(const std::vector<std::string>& arguments) {
  constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:=@%+";
  std::string line = "pullfocus";
  for (const std::string& word : arguments) {
    line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace pullfocus::cli::preview
