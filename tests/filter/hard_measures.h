// Measures of the hard cases that are no shots: steps of the table, the largest sum, budgets over a single bucket.
#pragma once

#include <vector>

#include "filter/options.h"
#include "hard_twins.h"

namespace pullfocus::test {

// How far a picture of one CoC changes from one table entry to the next: largest change of any pixel.
struct TableStep {
  double from_px = 0, to_px = 0;
  double edge = 0;         // of a vertical edge between 0 and 1
  double point = 0;        // of a single pixel of 1 on 0
  bool dims_point = true;  // the point's brightest pixel did not get brighter
};
std::vector<TableStep> table_steps(double up_to_px);

// What a depth stored in halves does to a slanted floor during a focus pull, against the same floor in floats: half
// steps are 1/1024 of the depth.
struct Terraces {
  double share = 0;       // of pixels whose table index differs
  int largest_index = 0;  // difference of indices
  double picture = 0;     // difference of any sample, texture 0..1
};
Terraces half_terraces();

// A picture with one pixel that gets the largest sum any settings allow: every source within reach has the kernel that
// weighs most there and the largest radiance.
struct LargestSum {
  double max_coc_px = 0;
  float radiance = 0;
  double overlap = 0;                                // B
  WideSum expected = 0, positive = 0, negative = 0;  // true sum, and the sums of lanes R (+) and G (-)
  double share() const { return static_cast<double>(expected) * 0x1p-63; }
};
// radiance 0: the largest that the options allow.
LargestSum largest_sum(double max_coc_px, float radiance);

// The largest radiance that kernels up to so many pixels allow.
float largest_radiance(double max_coc_px);

// A shot in which every pixel of 128 x 64 gets a new colour every frame and all changes fall into one bucket.
struct OneBucket {
  int longest_wait = 0;      // calls in a row for which some pixel's change was left over
  int fewest = 0, most = 0;  // updates of one frame in any block of 16 x 16, of those of `per_block` on average
  double per_block = 0;
  bool exact = true;  // the sums were those of the committed state after every frame
};
OneBucket one_bucket(const Budget& budget, int frames);

}  // namespace pullfocus::test
