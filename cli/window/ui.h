// The window's contents: drawn from a snapshot, answered with actions.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "preview/window_module.h"
#include "window/texture.h"

namespace pullfocus::cli::preview {

class Ui {
 public:
  Ui(Session& session, const WindowOptions& options);

  void draw();
  bool is_busy() const noexcept;  // draw again soon, without any event
  void release() { texture_.release(); }

  void ask_to_close();  // at once, or after asking about what would be lost
  bool may_close() const noexcept { return may_close_; }

 private:
  void act(std::string verb, std::vector<std::string> arguments = {});
  void hold();
  void release_hold();

  void draw_picture();
  ImVec2 picture_pixel(ImVec2 screen) const;  // of the state window, from its corner
  void drag_picture();
  void keep_zoom(ImVec2 screen, float zoom);
  void draw_reading(ImVec2 pixel);

  void draw_controls();
  void draw_view_controls();
  void draw_setting(const char* label, const char* name, const SettingNow& now, double least, double most,
                    const std::optional<KeyedValue>& keys, std::string& typed);
  void draw_camera_controls();
  void draw_filter_controls();
  void draw_export_controls();

  void draw_timeline();
  void draw_keys(const char* name, const std::optional<KeyedValue>& keys, float y, unsigned colour, ImVec2 origin,
                 float width);
  float frame_x(int frame, ImVec2 origin, float width) const;
  int frame_at(float x, ImVec2 origin, float width) const;
  void draw_status();
  void draw_help();
  void draw_close_question();
  void read_keyboard();

  Session& session_;
  Snapshot now_;
  Texture texture_;

  bool fits_ = true;
  float zoom_ = 1;       // screen pixels a picture pixel
  ImVec2 centre_{0, 0};  // of the view, in picture pixels
  ImVec2 area_corner_{0, 0}, area_size_{1, 1};
  enum class Drag { none, focus, aperture, pan };
  Drag drag_ = Drag::none;
  ImVec2 drag_from_{0, 0};
  double drag_value_ = 0;
  int last_x_ = -1, last_y_ = -1;
  bool holding_ = false;

  std::string typed_focus_, typed_fstop_, typed_focal_length_, typed_budget_, typed_kernel_, typed_visibility_;
  std::string export_file_, export_shot_, keys_file_;
  std::string moving_key_;  // setting whose key is dragged; empty: none
  int moving_from_ = 0;
  bool help_ = false, ask_close_ = false, may_close_ = false;
  bool scrubbing_ = false;

  std::uint64_t last_picture_ = 0;
  double last_time_ = 0;
  int pictures_ = 0;
  float pictures_a_second_ = 0;
};

}  // namespace pullfocus::cli::preview
