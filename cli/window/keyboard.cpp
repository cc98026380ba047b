// Of the window: the keyboard.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

#include "window/ui.h"

namespace pullfocus::cli::preview {

void Ui::read_keyboard() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || ask_close_) return;
  for (const ImWchar c : io.InputQueueCharacters) {
    if (c == '?') help_ = !help_;
    if (c == '+' || c == '=')
      keep_zoom({area_corner_.x + area_size_.x / 2, area_corner_.y + area_size_.y / 2}, zoom_ * 2);
    if (c == '-') keep_zoom({area_corner_.x + area_size_.x / 2, area_corner_.y + area_size_.y / 2}, zoom_ / 2);
    if (c == '[' || c == ']') {
      const float exposure = std::clamp(now_.look.exposure + (c == '[' ? -0.5f : 0.5f), -20.f, 20.f);
      act("exposure", {fmt::format("{:.3g}", exposure)});
    }
  }
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
  const auto repeated = [](int key) { return ImGui::IsKeyPressed(key); };
  if (io.KeyCtrl) {
    if (repeated(GLFW_KEY_Z)) act(io.KeyShift ? "redo" : "undo");
    if (repeated(GLFW_KEY_Y)) act("redo");
    if (pressed(GLFW_KEY_S)) act("save-keys", {keys_file_});
    if (pressed(GLFW_KEY_E)) act("export-shot", {export_shot_});
    if (pressed(GLFW_KEY_Q)) ask_to_close();
    return;
  }
  if (pressed(GLFW_KEY_F1)) help_ = !help_;
  if (pressed(GLFW_KEY_ESCAPE)) help_ = false;
  if (pressed(GLFW_KEY_SPACE)) act(now_.playing ? "pause" : "play");
  if (repeated(GLFW_KEY_LEFT)) act("step", {"-1"});
  if (repeated(GLFW_KEY_RIGHT)) act("step", {"1"});
  if (pressed(GLFW_KEY_HOME)) act("frame", {std::to_string(now_.frames.front())});
  if (pressed(GLFW_KEY_END)) act("frame", {std::to_string(now_.frames.back())});
  for (int view = 0; view < kViews; ++view) {
    if (pressed(GLFW_KEY_1 + view)) act("view", {kViewNames[view]});
  }
  if (pressed(GLFW_KEY_K)) act(io.KeyShift ? "unkey" : "key", {"focus"});
  if (pressed(GLFW_KEY_E)) act("export", {export_file_});
  if (pressed(GLFW_KEY_F)) fits_ = true;
  if (pressed(GLFW_KEY_Z)) keep_zoom({area_corner_.x + area_size_.x / 2, area_corner_.y + area_size_.y / 2}, 1);
  if (pressed(GLFW_KEY_W)) act("wipe", {now_.look.wipe ? "off" : "0.5"});
  if (pressed(GLFW_KEY_R)) act("reload");
}

}  // namespace pullfocus::cli::preview
