#include "exr/state_window.h"

#include <fmt/format.h>

#include <charconv>

#include "exr/file_info.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

constexpr int max_margin = 1 << 20;

[[noreturn]] void fail(std::string_view text) {
  throw Error(ErrorCode::usage,
              fmt::format("--overscan {}: neither 'auto' nor four pixel counts left,top,right,bottom of 0 to {}", text,
                          max_margin));
}

}  // namespace

Overscan parse_overscan(std::string_view text) {
  if (text == "auto") return {};
  Overscan overscan{.automatic = false};
  const char* next = text.data();
  const char* const end = text.data() + text.size();
  for (int* margin : {&overscan.left, &overscan.top, &overscan.right, &overscan.bottom}) {
    if (margin != &overscan.left && (next == end || *next++ != ',')) fail(text);
    const auto [stop, error] = std::from_chars(next, end, *margin);
    if (error != std::errc{} || *margin < 0 || *margin > max_margin) fail(text);
    next = stop;
  }
  if (next != end) fail(text);
  return overscan;
}

Window state_window(const Window& display_window, const Window& data_union, const Overscan& overscan) {
  const Window& display = display_window;
  const Window window = overscan.automatic ? unite(display, data_union)
                                           : Window{display.x0 - overscan.left, display.y0 - overscan.top,
                                                    display.x1 + overscan.right, display.y1 + overscan.bottom};
  if (window.pixels() > max_image_pixels) {
    throw Error(
        ErrorCode::usage,
        fmt::format("the window to work in would be {} x {} pixels, too large; limit it with --overscan L,T,R,B",
                    window.width(), window.height()));
  }
  return window;
}

}  // namespace pullfocus::exr
