// Runs the real program, and looks at what it leaves behind.
#pragma once

#include <string>
#include <vector>

#include "exr_files.h"

namespace pullfocus::test {

using exr::test::TempFolder;
using exr::test::TestImage;

struct Outcome {
  int code = -1;
  std::string out, err;

  std::size_t error_lines() const;
};

// pullfocus ARGUMENTS; the arguments go through a shell.
Outcome run(const std::string& arguments);
Outcome run_program(const std::string& program, const std::string& arguments);  // another copy of it

// `../shared/data/NAME`, or empty if it is not there.
std::string shared_data(const std::string& name);

// A shot `shot.####.exr` in `folder`: 24x18 pixels, half RGBA + float Z, a square that moves over a slanted wall,
// camera in the header (50 mm, f/2, focus 2 m).
void write_shot(const TempFolder& folder, int first, int last);

// Nothing in the folder is a temporary file of the writer.
void expect_no_temporaries(const TempFolder& folder);

// Same windows and same bits of all channels in both files.
testing::AssertionResult same_pixels(const std::string& a, const std::string& b);

}  // namespace pullfocus::test
