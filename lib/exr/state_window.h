// The window that a whole shot is filtered in.
#pragma once

#include <string_view>

#include "image/window.h"

namespace pullfocus::exr {

// Room around the display window, in pixels >= 0; or, automatic, as much as the files' data windows take.
struct Overscan {
  bool automatic = true;
  int left = 0, top = 0, right = 0, bottom = 0;

  bool operator==(const Overscan&) const = default;
};

// `auto` or `L,T,R,B`. Throws Error(usage).
Overscan parse_overscan(std::string_view text);

// Automatic: the smallest window that holds both; else `display_window` grown by the four margins.
// Throws Error(usage) if the result has more than max_image_pixels pixels.
Window state_window(const Window& display_window, const Window& data_union, const Overscan& overscan);

}  // namespace pullfocus::exr
