// Of the window: the line at the bottom.
#include <fmt/format.h>

#include "window/ui.h"

namespace pullfocus::cli::preview {

void Ui::draw_status() {
  const Shown& shown = *now_.shown;
  const double time = ImGui::GetTime();
  if (shown.picture_id != last_picture_) {
    ++pictures_;
    last_picture_ = shown.picture_id;
  }
  if (time - last_time_ > 0.5) {
    pictures_a_second_ = static_cast<float>(pictures_ / (time - last_time_));
    pictures_ = 0;
    last_time_ = time;
  }
  const double pixels = static_cast<double>(now_.width) * now_.height;
  std::string text;
  if (!shown.problem.empty()) {
    ImGui::TextColored({1, 0.5f, 0.4f, 1}, "%s", shown.problem.c_str());
  } else {
    if (shown.exact) {
      text = "exact";
    } else {
      text = fmt::format("{:.1f} % pending, off by {:.3g} at most in {:.0f} % of the picture",
                         pixels > 0 ? 100 * static_cast<double>(shown.left.pixels) / pixels : 0, shown.left.error_bound,
                         shown.left.share * 100);
    }
    text += fmt::format("   first picture {:.0f} ms, {} {:.0f} ms", shown.first_ms, shown.exact ? "exact" : "so far",
                        shown.total_ms);
  }
  text +=
      fmt::format("   {:.0f} pictures/s   {:.0f} MB", pictures_a_second_, static_cast<double>(now_.memory_bytes) / 1e6);
  if (now_.writing > 0) text += fmt::format("   writing {}", now_.writing);
  ImGui::TextUnformatted(text.c_str());
  if (now_.message.empty()) {
    ImGui::TextDisabled("? for help");
  } else if (now_.message_is_error) {
    ImGui::TextColored({1, 0.5f, 0.4f, 1}, "%s", now_.message.c_str());
  } else {
    ImGui::TextUnformatted(now_.message.c_str());
  }
}

}  // namespace pullfocus::cli::preview
