// Where output frames go.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "exr/pattern.h"

namespace pullfocus::exr {

// `text` names an existing folder (or ends in '/'): the input's file names are used in it. Otherwise it is a
// pattern, or one single file when one frame is written.
class OutputNames {
 public:
  // `frames`: what will be written. Looks at the disk, creates nothing. Throws Error(usage): several frames
  // into one file, a frame range in the output's name, or an output that would replace its own input.
  OutputNames(std::string_view text, const Pattern& input, const std::vector<int>& frames);

  std::string path(int frame) const { return pattern_.path(frame); }
  std::string folder() const { return pattern_.folder(); }

  // Throws Error(unwritable) unless folder() is there. Separate, so that a caller may create it first.
  void require_folder() const;

 private:
  Pattern pattern_;
};

}  // namespace pullfocus::exr
