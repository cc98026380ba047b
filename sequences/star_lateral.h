// "star-lateral": the first experiment of P. Fearing, "Importance Ordering for Real-Time Depth of Field",
// 1996, section 6.1. A star in focus moves from left to right between an unfocused foreground, which it
// passes behind, and an unfocused background. Nothing else changes from frame to frame, not by a bit.
//
// Camera: the paper's F = 8 mm, n = 3.5, focus at 40 mm, lens model `paper`. The paper gives no film size.
// Here the shorter side of the film is 16/7 mm = 2.286 mm, because then the nearest surface, a cord at 20 mm,
// has
//
//   |c| = (F/n) v |1/P - 1/U| = (8/3.5) 10 |1/40 - 1/20| mm = 4/7 mm,      v = 1 / (1/8 - 1/40) = 10 mm
//
// which is a quarter of that side: 64 pixels at 256x256, 270 at 1920x1080. No surface has a larger one;
// infinity, which nothing reaches, would have the same.
//
// Positions are in picture units: origin at the centre, x right, y up, the shorter side of the picture is 1
// long. A wider picture shows more of the scene. Depth is planar, in metres, sampled at the pixel centre;
// colour is the mean of 4x4 samples over the pixel, as renderers filter colour but not depth.
#pragma once

#include <string_view>

#include "camera/thin_lens.h"
#include "image/frame.h"

namespace pullfocus::sequences {

inline constexpr std::string_view star_lateral_name = "star-lateral";
inline constexpr std::string_view star_lateral_description =
    "a sharp star moves left to right behind a blurred cord and in front of a blurred room (Fearing 1996, "
    "experiment 1)";

// Before first_frame and after last_frame the star stands still.
struct StarLateral {
  int width = 256, height = 256;  // pixels, >= 1
  int first_frame = 1, last_frame = 100;
};

// Throws Error(usage).
void validate(const StarLateral& scene);

// The lens to filter the sequence with. Depth unit 1 metre; sensor_mm is the film's width.
ThinLens star_lens(const StarLateral& scene);
double star_sensor_height_mm(const StarLateral& scene);

// Pixels outside this window show nothing of the star in that frame; the window lies inside the picture.
Window star_window(const StarLateral& scene, int frame);

// Holds the picture without the star, so that a frame costs a copy and the star's own pixels. Rendering is
// const, may run on several threads at once, uses the calling arena's threads, and gives the same bits with
// any number.
class StarLateralRenderer {
 public:
  explicit StarLateralRenderer(const StarLateral& scene);  // throws Error(usage)

  const StarLateral& scene() const noexcept { return scene_; }

  // Half RGB with A = 1 (has_alpha false), float depth, window 0,0 to width,height; reuses memory of `out`.
  void render(int frame, Frame& out) const;

 private:
  StarLateral scene_;
  Frame without_star_;
};

// One frame of its own; for several, keep a StarLateralRenderer.
void render(const StarLateral& scene, int frame, Frame& out);

}  // namespace pullfocus::sequences
