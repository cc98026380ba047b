#include "exr/frame_check.h"

#include <cmath>

namespace pullfocus::exr::test {

void expect_frame(const Frame& frame, const TestImage& image, const std::string& prefix) {
  const char* names[] = {"R", "G", "B", "A"};
  for (int y = frame.window().y0; y < frame.window().y1; ++y) {
    for (int x = frame.window().x0; x < frame.window().x1; ++x) {
      const bool has_data = image.data.contains(x, y);
      for (int c = 0; c < (frame.has_alpha ? 4 : 3); ++c) {
        ASSERT_EQ(frame.colour.get(x, y, c), has_data ? image.value(prefix + names[c], x, y) : 0)
            << names[c] << " at " << x << "," << y;
      }
      if (!frame.has_alpha) {
        ASSERT_EQ(frame.colour.get(x, y, 3), 1) << x << "," << y;
      }
      ASSERT_EQ(frame.depth.at(x, y), has_data ? image.value(prefix + "Z", x, y) : INFINITY) << x << "," << y;
    }
  }
}

Read read_scanlines(const TestImage& image, const Window& state, const ChannelOptions& options) {
  TempFolder folder;
  write_scanlines(folder / "a.exr", image);
  Read result;
  result.outside = read_frame(folder / "a.exr", options, state, result.frame, &result.extra);
  return result;
}

}  // namespace pullfocus::exr::test
