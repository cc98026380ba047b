// Frames of a shot: the sharp picture with its depth, all surfaces behind each other, and the truth that a
// depth-of-field filter tries to reach.
//
// All pictures are box-filtered over the pixel, use the same shading, and consist of the same bits for any number of
// threads (oneTBB tasks of the calling arena) and whatever else was rendered before. Samples are placed alike in every
// frame, so that what stands still keeps its bits.
#pragma once

#include <memory>
#include <vector>

#include "image/frame.h"
#include "render/intersector.h"
#include "render/shot.h"
#include "render/still_pixels.h"

namespace pullfocus::sequences {

// Depth where a ray meets nothing: beyond planar_background_from, and finite, for deep files' sake.
inline constexpr float sky_depth = 1e10f;

// All surfaces along the rays through the pixel centres, nearest first; the last sample of each is the sky. Opaque, of
// no thickness.
struct DeepPixels {
  int width = 0, height = 0;
  struct Sample {
    float depth = 0;
    glm::vec3 colour{0};
  };
  std::vector<std::vector<Sample>> pixels;  // rows top down
};

class ShotRenderer {
 public:
  // Size in pixels, 1 .. 16384. Throws Error(usage).
  ShotRenderer(Shot shot, int width, int height);
  ~ShotRenderer();

  const Shot& shot() const noexcept { return shot_; }
  FrameLens lens(int frame) const { return frame_lens(shot_, frame, raster_.width, raster_.height); }

  // The pinhole picture: half RGB (A = 1, has_alpha false), mean of `samples` >= 1 a pixel; planar depth in metres of
  // what the pixel's centre shows, or sky_depth. With `still`, pixels are taken from there where that makes no
  // difference.
  void render(int frame, int samples, Frame& out, StillPixels* still = nullptr) const;

  // Through the lens: float RGB, mean of `samples` >= 1 a pixel, each from a point of its own on the lens, stratified
  // over lens and pixel (R. Cook et al., "Distributed Ray Tracing", 1984). Without the shot's noise.
  void truth(int frame, int samples, ColourImage& out, StillPixels* still = nullptr) const;

  // The same as a mean of whole pinhole pictures from `views` >= 1 points of the lens (P. Haeberli and K. Akeley, "The
  // Accumulation Buffer", 1990): all pixels share their lens points.
  void truth_of_views(int frame, int views, ColourImage& out) const;

  void deep(int frame, DeepPixels& out) const;

 private:
  struct Stage;  // one frame, ready for rays
  std::unique_ptr<Stage> stage(int frame) const;
  void measure_openness(const Intersector& moving);
  template <class Draw, class Store>
  void draw(int frame, const Stage& now, const StillPixels::Setting& setting, StillPixels* still,
            const Draw& draw_pixel, const Store& store_pixel) const;
  FrameCamera camera(int frame, const std::vector<glm::mat4>& world) const;

  Shot shot_;
  Raster raster_;
  Device device_;
  std::vector<char> moves_;                   // a flag a node
  std::unique_ptr<Intersector> still_;        // meshes that no animation moves
  Reach reach_;                               // of the others
  std::vector<std::vector<float>> openness_;  // of the moving ones, in their order
};

}  // namespace pullfocus::sequences
