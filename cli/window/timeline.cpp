// Of the window: frames, keys and playing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "window/ui.h"

namespace pullfocus::cli::preview {

namespace {

constexpr float kRow = 16;

}  // namespace

float Ui::frame_x(int frame, ImVec2 origin, float width) const {
  const int first = now_.frames.front(), last = now_.frames.back();
  const float share = last > first ? static_cast<float>(frame - first) / static_cast<float>(last - first) : 0.5f;
  return origin.x + 8 + share * (width - 16);
}

int Ui::frame_at(float x, ImVec2 origin, float width) const {
  const int first = now_.frames.front(), last = now_.frames.back();
  const float share = std::clamp((x - origin.x - 8) / std::max(width - 16, 1.f), 0.f, 1.f);
  return first + static_cast<int>(std::lround(share * static_cast<float>(last - first)));
}

void Ui::draw_timeline() {
  if (ImGui::Button(now_.playing ? "pause" : "play")) act(now_.playing ? "pause" : "play");
  ImGui::SameLine();
  if (ImGui::Button("|<")) act("frame", {std::to_string(now_.frames.front())});
  ImGui::SameLine();
  if (ImGui::Button("<")) act("step", {"-1"});
  ImGui::SameLine();
  if (ImGui::Button(">")) act("step", {"1"});
  ImGui::SameLine();
  if (ImGui::Button(">|")) act("frame", {std::to_string(now_.frames.back())});
  ImGui::SameLine();
  bool loop = now_.loop;
  if (ImGui::Checkbox("loop", &loop)) act("loop", {loop ? "on" : "off"});
  ImGui::SameLine();
  bool live = now_.live;
  if (ImGui::Checkbox("live", &live)) act("live", {live ? "on" : "off"});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("take in frames as they are written");
  ImGui::SameLine();
  float fps = static_cast<float>(now_.fps);
  ImGui::SetNextItemWidth(80);
  if (ImGui::DragFloat("fps", &fps, 0.25f, 1, 120, "%.4g"))
    act("fps", {fmt::format("{:.4g}", std::clamp(fps, 0.1f, 240.f))});
  ImGui::SameLine();
  ImGui::Text("frame %d of %d to %d", now_.frames[now_.frame], now_.frames.front(), now_.frames.back());
  ImGui::SameLine();
  ImGui::TextDisabled("%lld dropped", static_cast<long long>(now_.dropped));

  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 4 * kRow + 8;
  ImGui::InvisibleButton("frames", {std::max(width, 16.f), height});
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(origin, {origin.x + width, origin.y + height}, IM_COL32(30, 30, 34, 255));
  for (std::size_t i = 0; i < now_.frames.size(); ++i) {
    const float x = frame_x(now_.frames[i], origin, width);
    const bool loaded = i < now_.loaded.size() && now_.loaded[i];
    list->AddLine({x, origin.y + 2}, {x, origin.y + kRow - 4},
                  loaded ? IM_COL32(120, 190, 120, 255) : IM_COL32(90, 90, 90, 255));
  }
  const float at = frame_x(now_.frames[now_.frame], origin, width);
  list->AddRectFilled({at - 1.5f, origin.y}, {at + 1.5f, origin.y + height}, IM_COL32(255, 200, 60, 255));
  const std::string number = std::to_string(now_.frames[now_.frame]);
  list->AddText({std::min(at + 5, origin.x + width - 30), origin.y}, IM_COL32(255, 220, 130, 255), number.c_str());

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const int row = static_cast<int>((mouse.y - origin.y) / kRow);
  const std::optional<KeyedValue>* const rows[] = {nullptr, &now_.keys.focus, &now_.keys.fstop,
                                                   &now_.keys.focal_length};
  const char* const names[] = {"", "focus", "fstop", "focal-length"};
  const unsigned colours[] = {0, IM_COL32(110, 200, 255, 255), IM_COL32(255, 150, 110, 255),
                              IM_COL32(200, 160, 255, 255)};
  for (int r = 1; r < 4; ++r)
    draw_keys(names[r], *rows[r], origin.y + (static_cast<float>(r) + 0.5f) * kRow, colours[r], origin, width);

  if (ImGui::IsItemActivated()) {
    moving_key_.clear();
    scrubbing_ = true;
    if (row >= 1 && row < 4 && *rows[row] && !(*rows[row])->is_constant()) {
      for (const Key& key : (*rows[row])->keys()) {
        if (std::abs(frame_x(key.frame, origin, width) - mouse.x) > 6) continue;
        moving_key_ = names[row];
        moving_from_ = key.frame;
        scrubbing_ = false;
      }
    }
    if (!moving_key_.empty()) hold();
  }
  const int frame = frame_at(mouse.x, origin, width);
  if (ImGui::IsItemActive() && scrubbing_ && frame != now_.frames[now_.frame]) {
    const auto nearest = std::min_element(now_.frames.begin(), now_.frames.end(),
                                          [&](int a, int b) { return std::abs(a - frame) < std::abs(b - frame); });
    if (*nearest != now_.frames[now_.frame]) act("frame", {std::to_string(*nearest)});
  }
  if (ImGui::IsItemActive() && !moving_key_.empty() && frame != moving_from_) {
    act("move-key", {moving_key_, std::to_string(moving_from_), std::to_string(frame)});
    moving_from_ = frame;
  }
  if (ImGui::IsItemDeactivated()) {
    if (!moving_key_.empty()) release_hold();
    moving_key_.clear();
    scrubbing_ = false;
  }
}

void Ui::draw_keys(const char* name, const std::optional<KeyedValue>& keys, float y, unsigned colour, ImVec2 origin,
                   float width) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (!keys || keys->is_constant()) return;
  list->AddLine({origin.x, y}, {origin.x + width, y}, IM_COL32(70, 70, 80, 255));
  list->AddText({origin.x + 14, y - 13}, (colour & 0x00ffffffu) | 0x60000000u, name);
  for (const Key& key : keys->keys()) {
    const float x = frame_x(key.frame, origin, width);
    if (x < origin.x || x > origin.x + width) continue;
    list->AddQuadFilled({x - 5, y}, {x, y - 5}, {x + 5, y}, {x, y + 5}, colour);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsItemHovered() && std::abs(mouse.x - x) < 6 && std::abs(mouse.y - y) < kRow / 2) {
      ImGui::SetTooltip("%s %g at frame %d; drag to move, Del to remove", name, key.value, key.frame);
      if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Delete))) act("unkey", {name, std::to_string(key.frame)});
    }
  }
}

}  // namespace pullfocus::cli::preview
