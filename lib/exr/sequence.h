// A shot on disk: which frames there are, and what all their headers say together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "exr/file_info.h"
#include "exr/pattern.h"
#include "image/window.h"

namespace pullfocus::exr {

struct SequenceFrame {
  int frame = 0;
  std::string path;
  Window data_window;   // empty if there is a problem
  std::string problem;  // why the frame cannot be used: a whole message; empty: nothing known against it
};

struct Sequence {
  Pattern pattern;
  std::vector<SequenceFrame> frames;  // to be worked on, in the order asked for
  std::vector<int> gaps;              // without a range: numbers missing between first and last, a million at most
  FileInfo first;                     // of the first usable one among `frames`
  Window display_window;              // shared by all files
  Window data_union;                  // of all usable files that the pattern finds, worked on or not
};

// What a frame that is missing, unreadable or of another geometry means to open_sequence().
enum class BadFrames {
  fail,  // an error
  keep   // it is listed with its problem
};

// Finds the frames and reads the headers (no pixels) of all files the pattern finds, in parallel.
// `range`: as parse_frames(); empty: the range in the pattern, or else every file there is, in order.
// All files must share display window and pixel aspect. Headers of files outside the range count too, so that
// every chunk of a shot gets the same state window; those that cannot be read are left out. Throws
// Error(usage) for a malformed range; Error(unreadable) if nothing is found or usable, and for the first bad
// frame unless kept, naming frame and path.
Sequence open_sequence(const Pattern& pattern, std::string_view range, BadFrames bad_frames = BadFrames::fail);

}  // namespace pullfocus::exr
