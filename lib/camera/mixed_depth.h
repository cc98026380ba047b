// Single pixels of a depth image: mixed or not, see camera/depth_repair.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "camera/depth.h"
#include "image/frame.h"

namespace pullfocus {

// Coordinates count from the window's corner. Reads the frame's depth and alpha, and keeps depth as disparity: linear
// over the picture for planes. All but set() may run on any number of threads.
class MixedDepth {
 public:
  static constexpr int kReach = 4;  // rows and columns beyond which no pixel matters to another's replacement()

  MixedDepth(const Frame& frame, DepthKind kind);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  std::size_t at(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // Says that the frame's depth has changed there.
  void set(int x, int y, float depth) noexcept;

  // Columns of row y whose neighbours on two sides are far apart; only such a pixel can lie between two surfaces.
  void torn(int y, std::vector<int>& columns) const;

  // (x, y) should have the depth of (from_x, from_y).
  struct Change {
    int x, y;
    int from_x, from_y;
  };
  // If a pixel lies between two surfaces. The narrowest way from one to the other counts, of these the widest gap.
  std::optional<Change> replacement(int x, int y) const noexcept;

  // Whether a surface leads on to the pixel: two pixels in a row that are no candidates (at() indexes them), and the
  // step from them not far beyond their own.
  bool continues_surface(int x, int y, const std::vector<std::uint8_t>& candidate) const noexcept;

  // Steps to the right and down from the pixel that lead from one surface to another at once.
  int sharp_steps(int x, int y) const noexcept;

 private:
  struct Line;     // through a pixel
  struct Mixture;  // whose depth it gets along a line

  float stored(int x, int y) const noexcept { return frame_.depth.at(frame_.window().x0 + x, frame_.window().y0 + y); }
  bool may_lie_between(const Line& line) const noexcept;
  Mixture mixture(const Line& line, int a, int b) const noexcept;
  Mixture of_surfaces(const Line& line, int a, int b) const noexcept;
  Mixture with_empty(const Line& line, int surface, int empty) const noexcept;

  const Frame& frame_;
  const DepthKind kind_;
  const int width_, height_;
  std::vector<float> disparity_;
};

}  // namespace pullfocus
