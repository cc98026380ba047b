// Runs filters over a shot, frame by frame, and measures their pictures. Frames are streamed: memory is that of the
// filters and of a handful of pictures, whatever the length of the shot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/combinations.h"
#include "compare/results.h"
#include "shot.h"

namespace pullfocus::cli {

struct CompareArguments {
  std::vector<std::string> inputs, truths, references, fail_above, fail_below;
  CombinationLists lists;
  bool given = false, no_quantisation = false;
  double peak = 1;
  int measure_every = 1;  // errors on every k-th frame, from the first
  std::string json, csv, html, markdown;
};

inline constexpr int kQuickFrames = 6;

// All filters on every frame before the next frame, in an order that moves on from frame to frame, so that what else
// the machine does falls on all of them alike. `truth`: empty for none. Throws Error; Error(content) if interrupted.
class FilterComparison {
 public:
  FilterComparison(const InputArguments& input, const CameraArguments& camera, const std::vector<Group>& groups,
                   const CompareArguments& arguments, const std::string& truth);
  ~FilterComparison();
  ShotResult run();  // with a progress line

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

// The input's own pictures against the reference's, over the display window and all data; every frame that either has.
ShotResult compare_given(const InputArguments& input, const std::string& reference, const CompareArguments& arguments);

}  // namespace pullfocus::cli
