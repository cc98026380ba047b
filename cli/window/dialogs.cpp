// Of the window: help, and the question before it closes.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "window/ui.h"

namespace pullfocus::cli::preview {

void Ui::draw_help() {
  if (!help_) return;
  ImGui::SetNextWindowPos({area_corner_.x + 40, area_corner_.y + 40}, ImGuiCond_Appearing);
  if (ImGui::Begin("Help (? closes it)", &help_, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
    const char* const lines[][2] = {
        {"click, drag", "focus on what is under the mouse"},
        {"Ctrl + drag", "open (left) or close (right) the aperture"},
        {"middle or right drag", "move the picture"},
        {"wheel, + and -", "zoom"},
        {"F, Z", "fit, 1:1"},
        {"1 ... 6", "result, input, depth, CoC, pending importance, difference to the exact picture"},
        {"[ and ]", "exposure"},
        {"W", "wipe between the input and the view"},
        {"Space", "play or pause"},
        {"Left, Right, Home, End", "frames"},
        {"K, Shift+K", "set or remove a focus key here"},
        {"drag a key, Del over it", "move it, remove it"},
        {"Ctrl+Z, Ctrl+Shift+Z", "undo, redo"},
        {"Ctrl+S", "save the keys"},
        {"E, Ctrl+E", "export this frame, the shot"},
        {"R", "read this frame's file again"},
        {"Ctrl+Q", "quit"},
    };
    for (const auto& line : lines) {
      ImGui::TextUnformatted(line[0]);
      ImGui::SameLine(200);
      ImGui::TextUnformatted(line[1]);
    }
  }
  ImGui::End();
}

void Ui::ask_to_close() {
  if (now_.unsaved || now_.job || now_.writing > 0) {
    ask_close_ = true;
  } else {
    may_close_ = true;
  }
}

void Ui::draw_close_question() {
  if (!ask_close_) return;
  const char* const title = "Close the preview?";
  ImGui::OpenPopup(title);
  if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (now_.unsaved) ImGui::TextUnformatted("Camera keys were changed and are not saved.");
  if (now_.job) ImGui::TextUnformatted("A shot is being written; closing stops it after the frame at hand.");
  if (now_.writing > 0) ImGui::TextUnformatted("A frame is being written; closing waits for it.");
  if (now_.message_is_error) ImGui::TextUnformatted(now_.message.c_str());
  if (now_.unsaved) {
    ImGui::SetNextItemWidth(260);
    ImGui::InputText("##file", &keys_file_);
    if (ImGui::Button("save and close (Enter)") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)) {
      act("save-keys", {keys_file_});
      now_ = session_.snapshot();
      may_close_ = !now_.unsaved;  // else the message says why not
    }
    ImGui::SameLine();
  }
  if (ImGui::Button(now_.unsaved ? "discard and close" : "close")) may_close_ = true;
  ImGui::SameLine();
  if (ImGui::Button("cancel (Esc)") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
    ask_close_ = false;
  if (!ask_close_ || may_close_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace pullfocus::cli::preview
