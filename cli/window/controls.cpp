// Of the window: the column of settings.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>  // after imgui.h

#include <algorithm>
#include <cmath>

#include "window/ui.h"

namespace pullfocus::cli::preview {

namespace {

std::string text_of(double value) { return fmt::format("{:.6g}", value); }

// True once when Enter is pressed or the field is left with another text.
bool type(const char* label, std::string& text) {
  ImGui::InputText(label, &text);
  return ImGui::IsItemDeactivatedAfterEdit();
}

template <std::size_t n>
bool choose(const char* label, const std::string& now, const char* const (&choices)[n], std::string& chosen) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, now.c_str())) return false;
  for (const char* choice : choices) {
    if (ImGui::Selectable(choice, now == choice) && now != choice) {
      chosen = choice;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

}  // namespace

void Ui::draw_controls() {
  if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) draw_view_controls();
  if (now_.has_lens && ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) draw_camera_controls();
  if (ImGui::CollapsingHeader("Filter", ImGuiTreeNodeFlags_DefaultOpen)) draw_filter_controls();
  if (ImGui::CollapsingHeader("Keys and export", ImGuiTreeNodeFlags_DefaultOpen)) draw_export_controls();
}

void Ui::draw_view_controls() {
  std::string chosen;
  if (choose("view", kViewNames[static_cast<int>(now_.look.view)], kViewNames, chosen)) act("view", {chosen});
  float exposure = now_.look.exposure;
  if (ImGui::SliderFloat("exposure", &exposure, -8, 8, "%.2f stops"))
    act("exposure", {fmt::format("{:.3g}", exposure)});
  bool srgb = now_.look.srgb;
  if (ImGui::Checkbox("sRGB", &srgb)) act("srgb", {srgb ? "on" : "off"});
  ImGui::SameLine();
  bool wipe = now_.look.wipe.has_value();
  if (ImGui::Checkbox("wipe", &wipe)) act("wipe", {wipe ? "0.5" : "off"});
  if (now_.look.wipe) {
    float share = *now_.look.wipe;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##wipe", &share, 0, 1, "input | view")) act("wipe", {fmt::format("{:.4f}", share)});
  }
  if (ImGui::Button("fit (F)")) fits_ = true;
  ImGui::SameLine();
  if (ImGui::Button("1:1 (Z)")) {
    keep_zoom({area_corner_.x + area_size_.x / 2, area_corner_.y + area_size_.y / 2}, 1);
  }
  ImGui::SameLine();
  ImGui::Text("%.0f %%", static_cast<double>(zoom_) * 100);
}

// A slider, a field for typing and a key button.
void Ui::draw_setting(const char* label, const char* name, const SettingNow& now, double least, double most,
                      const std::optional<KeyedValue>& keys, std::string& typed) {
  ImGui::PushID(name);
  ImGui::TextUnformatted(label);
  ImGui::SameLine(110);
  ImGui::TextDisabled("%s", now.value ? now.source.c_str() : "not set");
  const double value = now.value.value_or(std::sqrt(least * most));
  float slider = std::isfinite(value) ? static_cast<float>(value) : static_cast<float>(most);
  ImGui::SetNextItemWidth(150);
  if (ImGui::SliderFloat("##slider", &slider, static_cast<float>(least), static_cast<float>(most),
                         std::isfinite(value) ? "%.4g" : "infinity",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput)) {
    act(name, {text_of(static_cast<double>(slider))});
  }
  if (ImGui::IsItemActivated()) hold();
  if (ImGui::IsItemDeactivated()) release_hold();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(72);
  if (type("##typed", typed)) act(name, {typed});
  if (!ImGui::IsItemActive()) typed = now.value ? text_of(*now.value) : "";
  ImGui::SameLine();
  const int frame = now_.frames[now_.frame];
  bool here = false;
  if (keys && !keys->is_constant()) {
    for (const Key& key : keys->keys()) here |= key.frame == frame;
  }
  if (ImGui::Button(here ? "- key" : "+ key")) act(here ? "unkey" : "key", {name});
  ImGui::PopID();
}

void Ui::draw_camera_controls() {
  const double near = now_.shown->depth_near, far = now_.shown->depth_far;
  const double least = near > 0 ? near / 2 : 0.01, most = far > near ? far * 2 : std::max(100., least * 100);
  draw_setting("focus", "focus", now_.focus, least, most, now_.keys.focus, typed_focus_);
  draw_setting("f-number", "fstop", now_.fstop, 0.5, 32, now_.keys.fstop, typed_fstop_);
  draw_setting("focal length", "focal-length", now_.focal_length, 8, 400, now_.keys.focal_length, typed_focal_length_);
  const char* const interpolations[] = {"dioptre", "distance", "smooth"};
  std::string chosen;
  ImGui::SetNextItemWidth(150);
  if (choose("between keys", interpolations[static_cast<int>(now_.keys.interpolation)], interpolations, chosen)) {
    act("interp", {chosen});
  }
}

void Ui::draw_filter_controls() {
  const char* const kernels[] = {"disc", "polygon:5", "polygon:6", "polygon:8", "gaussian", "diffraction"};
  const char* const visibilities[] = {"auto", "none", "bitmap:32"};
  std::string chosen;
  // A list of the usual ones, and a field for any.
  const auto row = [&](const char* label, const char* verb, const std::string& now, const auto& list,
                       std::string& typed) {
    ImGui::PushID(verb);
    ImGui::TextUnformatted(label);
    ImGui::SameLine(80);
    ImGui::SetNextItemWidth(110);
    if (choose("##list", now, list, chosen)) act(verb, {chosen});
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (type("##typed", typed)) act(verb, {typed});
    if (!ImGui::IsItemActive()) typed = now;
    ImGui::PopID();
  };
  row("kernel", "kernel", now_.kernel, kernels, typed_kernel_);
  row("visibility", "visibility", now_.visibility, visibilities, typed_visibility_);
  ImGui::TextUnformatted("budget");
  ImGui::SameLine(80);
  ImGui::SetNextItemWidth(110);
  if (type("##budget", typed_budget_)) act("budget", {typed_budget_});
  if (!ImGui::IsItemActive()) typed_budget_ = now_.budget;
  ImGui::SameLine();
  bool refine = now_.refine;
  if (ImGui::Checkbox("refine to exact", &refine)) act("refine", {refine ? "on" : "off"});
}

void Ui::draw_export_controls() {
  if (ImGui::Button("undo") && now_.can_undo) act("undo");
  ImGui::SameLine();
  if (ImGui::Button("redo") && now_.can_redo) act("redo");
  ImGui::SameLine();
  ImGui::TextDisabled(now_.unsaved ? "keys are not saved" : "");
  ImGui::SetNextItemWidth(200);
  type("##keys", keys_file_);
  ImGui::SameLine();
  if (ImGui::Button("save")) act("save-keys", {keys_file_});
  ImGui::SameLine();
  if (ImGui::Button("load")) act("load-keys", {keys_file_});
  ImGui::SetNextItemWidth(200);
  type("##frame", export_file_);
  ImGui::SameLine();
  if (ImGui::Button("export frame")) act("export", {export_file_});
  ImGui::SetNextItemWidth(200);
  type("##shot", export_shot_);
  ImGui::SameLine();
  if (now_.job) {
    if (ImGui::Button("cancel")) act("cancel");
    ImGui::ProgressBar(static_cast<float>(*now_.job), {-1, 0});
  } else if (ImGui::Button("export shot")) {
    act("export-shot", {export_shot_});
  }
  if (ImGui::Button("copy command")) ImGui::SetClipboardText(now_.command_line.c_str());
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", now_.command_line.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace pullfocus::cli::preview
