// Frame ranges as farm managers and artists write them: `1-10,12-100x2`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pullfocus::exr {

// Reads a comma list of N, A-B, A-BxS (every S-th), A-ByS (all that A-BxS leaves out). A may be larger than
// B, which counts backwards; numbers may be negative (`-10--5`). The order is kept, repeated frames are
// dropped. Throws Error(usage) that quotes the text: empty, malformed, step 0, beyond int, or more than 10
// million frames.
std::vector<int> parse_frames(std::string_view text);

// The inverse, compact, for messages: `1-3,7,9-13x2`. parse_frames() of it gives `frames` back (if without
// repeats).
std::string format_frames(const std::vector<int>& frames);

}  // namespace pullfocus::exr
