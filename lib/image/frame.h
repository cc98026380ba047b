// Images in memory: RGBA colour and one depth plane over a common window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/sample.h"
#include "image/window.h"

namespace pullfocus {

// Colour image, R,G,B,A interleaved, rows top down, no padding between rows. Premultiplied, scene-linear.
class ColourImage {
 public:
  ColourImage() = default;
  ColourImage(const Window& window, SampleType type) { reset(window, type); }

  // Sets every sample to 0. Reuses memory where it suffices.
  void reset(const Window& window, SampleType type);

  const Window& window() const noexcept { return window_; }
  SampleType type() const noexcept { return type_; }
  std::size_t pixel_bytes() const noexcept { return 4 * sample_bytes(type_); }
  std::size_t row_bytes() const noexcept { return pixel_bytes() * static_cast<std::size_t>(window_.width()); }

  // Address of pixel (x, y), in window coordinates; four samples of type().
  std::byte* pixel(int x, int y) noexcept { return samples_.data() + offset(x, y); }
  const std::byte* pixel(int x, int y) const noexcept { return samples_.data() + offset(x, y); }

  // One sample (channel 0..3 = R, G, B, A) whatever the type. Setting a half rounds to nearest even.
  float get(int x, int y, int channel) const noexcept;
  void set(int x, int y, int channel, float value) noexcept;

  bool operator==(const ColourImage&) const = default;  // window, type and bits

 private:
  std::size_t offset(int x, int y) const noexcept {
    return static_cast<std::size_t>(y - window_.y0) * row_bytes() +
           static_cast<std::size_t>(x - window_.x0) * pixel_bytes();
  }

  Window window_;
  SampleType type_ = SampleType::float32;
  std::vector<std::byte> samples_;
};

// One float plane (depth), rows top down, no padding.
class Plane {
 public:
  Plane() = default;
  Plane(const Window& window, float value) { reset(window, value); }
  void reset(const Window& window, float value);

  const Window& window() const noexcept { return window_; }
  float* row(int y) noexcept { return values_.data() + row_offset(y); }  // first value at x = window().x0
  const float* row(int y) const noexcept { return values_.data() + row_offset(y); }
  float& at(int x, int y) noexcept { return row(y)[x - window_.x0]; }
  const float& at(int x, int y) const noexcept { return row(y)[x - window_.x0]; }

 private:
  std::size_t row_offset(int y) const noexcept {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width());
  }

  Window window_;
  std::vector<float> values_;
};

// Pixels of such a mask value neither blur nor receive: they contribute nothing and show their own colour. NaN is not
// held out.
inline bool is_held_out(float mask) noexcept { return mask >= 0.5f; }

// What a filter reads: colour and depth over the same window (the state window). Pixels that the source had
// no data for hold colour 0 and a depth that its kind counts as background (see camera/depth.h).
struct Frame {
  ColourImage colour;
  Plane depth;            // as stored in the file, not yet converted
  bool has_alpha = true;  // false: the source has no alpha; colour's A is 1 everywhere
  Plane mask{};           // holdout (see is_held_out); empty window: no pixel is held out

  bool has_mask() const noexcept { return !mask.window().empty(); }
  bool holds_out(int x, int y) const noexcept { return has_mask() && is_held_out(mask.at(x, y)); }

  const Window& window() const noexcept { return colour.window(); }
};

}  // namespace pullfocus
