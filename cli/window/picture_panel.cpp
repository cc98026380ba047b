// Of the window: the picture, and what the mouse does there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "window/ui.h"

namespace pullfocus::cli::preview {

ImVec2 Ui::picture_pixel(ImVec2 screen) const {
  const float aspect = static_cast<float>(now_.pixel_aspect);
  return {centre_.x + (screen.x - area_corner_.x - area_size_.x / 2) / (zoom_ * aspect),
          centre_.y + (screen.y - area_corner_.y - area_size_.y / 2) / zoom_};
}

// Another zoom, with the picture's point under `screen` where it is.
void Ui::keep_zoom(ImVec2 screen, float zoom) {
  const ImVec2 before = picture_pixel(screen);
  zoom_ = std::clamp(zoom, 1.f / 32, 64.f);
  fits_ = false;
  const ImVec2 after = picture_pixel(screen);
  centre_ = {centre_.x + before.x - after.x, centre_.y + before.y - after.y};
}

void Ui::draw_picture() {
  area_corner_ = ImGui::GetCursorScreenPos();
  area_size_ = ImGui::GetContentRegionAvail();
  area_size_ = {std::max(area_size_.x, 16.f), std::max(area_size_.y, 16.f)};
  const float aspect = static_cast<float>(now_.pixel_aspect);
  const float width = static_cast<float>(std::max(now_.width, 1)),
              height = static_cast<float>(std::max(now_.height, 1));
  if (fits_) {
    zoom_ = std::min(area_size_.x / (width * aspect), area_size_.y / height);
    centre_ = {width / 2, height / 2};
  }
  ImGui::InvisibleButton(
      "picture", area_size_,
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{area_corner_.x + area_size_.x, area_corner_.y + area_size_.y};
  list->PushClipRect(area_corner_, end, true);
  list->AddRectFilled(area_corner_, end, IM_COL32(24, 24, 24, 255));
  const ImVec2 corner{area_corner_.x + area_size_.x / 2 - centre_.x * zoom_ * aspect,
                      area_corner_.y + area_size_.y / 2 - centre_.y * zoom_};
  const ImVec2 size{width * zoom_ * aspect, height * zoom_};
  if (now_.shown->picture) {
    texture_.show(now_.shown->picture);
    texture_.use_squares(zoom_ > 2);
    list->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture_.name())), corner,
                   {corner.x + size.x, corner.y + size.y});
  }
  if (now_.look.wipe) {
    const float x = corner.x + *now_.look.wipe * size.x;
    list->AddLine({x, corner.y}, {x, corner.y + size.y}, IM_COL32(255, 255, 255, 160));
  }
  drag_picture();
  if (ImGui::IsItemHovered()) draw_reading(picture_pixel(ImGui::GetIO().MousePos));
  if (now_.loading) {
    list->AddText({area_corner_.x + 12, area_corner_.y + 12}, IM_COL32(255, 220, 120, 255),
                  fmt::format("reading frame {} ...", now_.frames[now_.frame]).c_str());
  }
  list->PopClipRect();
}

// Left: focus on what is there; with Ctrl, open or close the aperture. Middle or right: move the picture. Wheel: zoom.
void Ui::drag_picture() {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) keep_zoom(io.MousePos, zoom_ * std::exp2(io.MouseWheel / 3));
  if (ImGui::IsItemActivated()) {
    drag_from_ = io.MousePos;
    last_x_ = last_y_ = -1;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
      drag_ = Drag::pan;
    } else {
      drag_ = io.KeyCtrl ? Drag::aperture : Drag::focus;
      drag_value_ = now_.fstop.value.value_or(2.8);
      hold();
    }
  }
  if (ImGui::IsItemActive()) {
    if (drag_ == Drag::pan) {
      const float aspect = static_cast<float>(now_.pixel_aspect);
      centre_ = {centre_.x - io.MouseDelta.x / (zoom_ * aspect), centre_.y - io.MouseDelta.y / zoom_};
      if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) fits_ = false;
    } else if (drag_ == Drag::aperture && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
      const double stops = static_cast<double>(io.MousePos.x - drag_from_.x) / 100;
      act("fstop", {fmt::format("{:.4g}", std::clamp(drag_value_ * std::exp2(stops / 2), 0.05, 1000.))});
    } else if (drag_ == Drag::focus) {
      const ImVec2 pixel = picture_pixel(io.MousePos);
      const int x = static_cast<int>(std::floor(pixel.x)), y = static_cast<int>(std::floor(pixel.y));
      const bool inside = x >= 0 && y >= 0 && x < now_.width && y < now_.height;
      if (inside && (x != last_x_ || y != last_y_)) {
        last_x_ = x;
        last_y_ = y;
        act("focus-at", {fmt::format("{},{}", x + now_.window_x0, y + now_.window_y0)});
      }
    }
  }
  if (ImGui::IsItemDeactivated()) {
    if (drag_ == Drag::focus || drag_ == Drag::aperture) release_hold();
    drag_ = Drag::none;
  }
}

void Ui::draw_reading(ImVec2 pixel) {
  const int x = static_cast<int>(std::floor(pixel.x)), y = static_cast<int>(std::floor(pixel.y));
  const Probe probe = session_.probe(x, y);
  if (!probe.inside) return;
  std::string text = fmt::format("{}, {}   ", x + now_.window_x0, y + now_.window_y0);
  text += probe.background ? "background" : fmt::format("depth {:.5g}", probe.depth);
  if (probe.has_coc) {
    text += fmt::format("   CoC {:+.2f} px {}", probe.coc,
                        std::abs(probe.coc) <= 1 ? "(in focus)"
                        : probe.coc < 0          ? "(in front)"
                                                 : "(behind)");
  }
  text += fmt::format("   RGBA {:.4g} {:.4g} {:.4g} {:.4g}", probe.colour[0], probe.colour[1], probe.colour[2],
                      probe.colour[3]);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{area_corner_.x + 8, area_corner_.y + area_size_.y - size.y - 8};
  list->AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, at.y + size.y + 2}, IM_COL32(0, 0, 0, 170));
  list->AddText(at, IM_COL32(235, 235, 235, 255), text.c_str());
}

}  // namespace pullfocus::cli::preview
