#include "compare/thumbnails.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "image/error.h"
#include "imageio/picture.h"
#include "metrics/flip.h"
#include "metrics/planes.h"

namespace pullfocus::cli {

namespace {

namespace fs = std::filesystem;

// A folder of its own, gone with all it holds.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "pullfocus.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw Error(ErrorCode::unwritable, name + ": cannot be created: set TMPDIR to a folder that can be written");
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string png_of(const imageio::Picture& picture) {
  const ScratchFolder folder;
  const std::string path = folder.file("picture.png");
  imageio::write_picture(path, picture);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

using ColourOf = std::function<std::array<float, 3>(int x, int y)>;  // displayable, linear

// Every pixel of the small picture is the mean of a square of pixels; what is left over at the right and below is cut.
imageio::Picture shrunk(const Window& w, const ColourOf& colour) {
  const int side = std::max((w.width() + kThumbnailWidth - 1) / kThumbnailWidth, 1);
  imageio::Picture small{std::max(1, w.width() / side), std::max(1, w.height() / side), {}};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      std::array<float, 3> sum{};
      const int x1 = std::min(w.x1, w.x0 + (x + 1) * side), y1 = std::min(w.y1, w.y0 + (y + 1) * side);
      int count = 0;
      for (int j = w.y0 + y * side; j < y1; ++j) {
        for (int i = w.x0 + x * side; i < x1; ++i, ++count) {
          const auto rgb = colour(i, j);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c];
        }
      }
      for (const float value : sum) small.rgba.push_back(value / static_cast<float>(count));
      small.rgba.push_back(1);
    }
  }
  return small;
}

// A ramp of rising lightness, sRGB-encoded, at 0, 1/6, ..., 1.
constexpr float kRamp[7][3] = {{0.00f, 0.00f, 0.02f}, {0.15f, 0.07f, 0.35f}, {0.40f, 0.11f, 0.50f},
                               {0.70f, 0.20f, 0.48f}, {0.93f, 0.37f, 0.37f}, {0.99f, 0.66f, 0.45f},
                               {0.99f, 0.99f, 0.75f}};

std::array<float, 3> ramp(float value) noexcept {
  const float at = std::clamp(value, 0.f, 1.f) * 6;
  const auto below = static_cast<std::size_t>(std::min(5.f, at));
  std::array<float, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float part = at - static_cast<float>(below);
    rgb[c] = imageio::srgb_decoded((1 - part) * kRamp[below][c] + part * kRamp[below + 1][c]);
  }
  return rgb;
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= bytes.size() - i ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

Picture64 thumbnail(const std::string& caption, const ColourImage& picture, const Window& window) {
  const Window& own = picture.window();
  const imageio::Picture small = shrunk(window, [&](int x, int y) {
    std::array<float, 3> rgb{};
    if (!own.contains(x, y)) return rgb;
    for (int c = 0; c < 3; ++c) rgb[static_cast<std::size_t>(c)] = displayable(picture.get(x, y, c));
    return rgb;
  });
  return {caption, base64(png_of(small)), small.width, small.height};
}

Picture64 error_thumbnail(const std::string& caption, const ColourImage& picture, const ColourImage& reference,
                          const Window& window) {
  const Plane map = flip_map(picture, reference, window);
  bool any = false;
  for (int y = window.y0; y < window.y1; ++y) {
    any |= std::any_of(map.row(y), map.row(y) + window.width(), [](float value) { return value != 0; });
  }
  const imageio::Picture small = shrunk(window, [&](int x, int y) { return ramp(map.at(x, y)); });
  return {caption, any ? base64(png_of(small)) : "", small.width, small.height};
}

}  // namespace pullfocus::cli
