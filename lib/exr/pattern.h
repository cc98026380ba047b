// File name patterns of frame sequences.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pullfocus::exr {

// A pattern is a path whose file name holds at most one placeholder for the frame number:
//   shot.####.exr, shot.#.exr   a run of n > 1 `#` stands for n digits, a lone `#` for 4
//   shot.@@@.exr                each `@` stands for 1 digit
//   shot.%04d.exr, shot.%d.exr  as printf
//   shot.1-100#.exr             with the frame range written before `#` or `@`
//   shot.exr                    none: one single file
// Numbers wider than the padding are written in full; the sign counts as a digit, as in printf (-5 as
// `-005`). Placeholders in folder names are ordinary characters.
class Pattern {
 public:
  // Does not look at the disk. Throws Error(usage): no file name, two placeholders, a malformed `%`.
  static Pattern parse(std::string_view text);

  const std::string& text() const noexcept { return text_; }
  bool is_single() const noexcept { return single_; }

  // Path of a frame's file. A single file has this path for every frame.
  std::string path(int frame) const;

  // Frame number of a single file: the last group of digits in its name before the extension, 1 if there is
  // none. Only for is_single().
  int single_frame() const;

  // Folder that all frames are in; "." if the text names none.
  std::string folder() const;

  // Frames in the range written into the pattern, in its order.
  const std::optional<std::vector<int>>& inline_range() const noexcept { return range_; }

  // Sorted frame numbers of the files in the folder that path() gives back exactly; empty if there are none.
  // Throws Error(unreadable) if the folder cannot be listed, or if a single file is missing or a folder.
  std::vector<int> discover() const;

 private:
  std::optional<int> frame_of(std::string_view file_name) const;

  std::string text_;
  std::string folder_prefix_;   // up to and including the last '/'
  std::string before_, after_;  // parts of the file name around the placeholder
  int digits_ = 0;              // width to pad to with zeros
  bool single_ = false;
  std::optional<std::vector<int>> range_;
};

}  // namespace pullfocus::exr
