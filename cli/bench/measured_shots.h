// Short analytic shots for measuring, all over the star-lateral scene at 256x256.
#pragma once

#include <string>
#include <vector>

#include "camera/thin_lens.h"
#include "image/frame.h"

namespace pullfocus::cli::bench {

struct MeasuredShot {
  std::string name, description;
  std::vector<Frame> frames;
  std::vector<CocFunction> coc;  // of every frame
};

// The star crosses the picture; focus holds (Fearing 1996, experiment 1).
MeasuredShot star_shot(int frames);
// Nothing moves; focus goes from 40 to 48 mm, in equal steps of dioptres, over all frames.
MeasuredShot slow_pull(int frames);
// Nothing moves; focus goes from 21 to 150 mm in a quarter of the frames and stays there.
MeasuredShot fast_pull(int frames);
// Nothing moves and focus holds; a pool of light crosses the picture.
MeasuredShot light_change(int frames);
// Nothing moves; F = 8 mm, n = 12, focus goes from the room (150 mm) to the knot (21 mm) (Fearing 1996, experiment 5).
MeasuredShot reversed_pull(int frames);

}  // namespace pullfocus::cli::bench
